// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_PROGRAM_SHELL_COMPLETION_H_
#define ANICODEC_TOOLS_PROGRAM_SHELL_COMPLETION_H_

#include "tools/program/command.h"
#include "tools/words/word_table.h"

#include <cstdint>
#include <string>

namespace anicodec::tools {

enum class Shell : uint8_t { kBash, kZsh, kFish };

/// The script by which a shell completes commands, options, and the words that an option takes; all
/// else it completes as names of files.
std::string shell_completion(const Program& program, const Commands& commands, Shell shell);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_PROGRAM_SHELL_COMPLETION_H_
