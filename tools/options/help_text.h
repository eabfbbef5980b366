// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_OPTIONS_HELP_TEXT_H_
#define ANICODEC_TOOLS_OPTIONS_HELP_TEXT_H_

#include "tools/options/options.h"

#include <string>
#include <utility>
#include <vector>

namespace anicodec::tools {

/// Heading of the options that commands share; it stands last.
inline constexpr const char* kGeneralGroup = "General";

/// A name in a column of names, and what it is, wrapped to the width of help.
std::string help_row(const std::string& name, const std::string& text);

/// Headings with their options, arguments first and general options last.
std::vector<std::pair<std::string, std::vector<const Option*>>> options_by_heading(
    const Options& options);

/// The options under their headings, arguments first, each heading preceded by an empty line.
std::string help_text(const Options& options);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_OPTIONS_HELP_TEXT_H_
