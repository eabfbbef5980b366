// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_PROGRAM_MANUAL_PAGE_H_
#define ANICODEC_TOOLS_PROGRAM_MANUAL_PAGE_H_

#include "tools/program/command.h"

#include <string>

namespace anicodec::tools {

/// The program's page of the manual, section 1, as troff with the macros of man(7).
std::string manual_page(const Program& program, const Commands& commands);

/// That of a command, which is named PROGRAM-COMMAND.
std::string manual_page(const Program& program, const Command& command);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_PROGRAM_MANUAL_PAGE_H_
