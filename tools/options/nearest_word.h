// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_OPTIONS_NEAREST_WORD_H_
#define ANICODEC_TOOLS_OPTIONS_NEAREST_WORD_H_

#include <span>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// The word that somebody may have meant, by the number of letters to change, add, drop or swap
/// (optimal string alignment distance): at most one in three. Empty if there is none; of several
/// the first one. Cost: O(letters squared) for each word.
std::string nearest_word(std::string_view typed, std::span<const std::string> words);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_OPTIONS_NEAREST_WORD_H_
