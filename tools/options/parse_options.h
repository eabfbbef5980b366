// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_OPTIONS_PARSE_OPTIONS_H_
#define ANICODEC_TOOLS_OPTIONS_PARSE_OPTIONS_H_

#include "tools/options/options.h"

#include <string>
#include <vector>

namespace anicodec::tools {

/// Reads the words that follow a command's name, and writes to the variables of its options: -o X,
/// -oX, --output X, --output=X, flags together as -qv, and -- before arguments that begin with a
/// dash. Throws Error(kUsage) naming what is unknown, missing, given twice or excluded by another
/// option.
void parse_options(const Options& options, const std::vector<std::string>& words);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_OPTIONS_PARSE_OPTIONS_H_
