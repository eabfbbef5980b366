// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_WORDS_WORD_LIST_H_
#define ANICODEC_TOOLS_WORDS_WORD_LIST_H_

#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// The parts of a list that commas separate, empty ones included. None of an empty list.
std::vector<std::string> split_at_commas(std::string_view list);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_WORD_LIST_H_
