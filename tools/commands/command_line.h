// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_COMMANDS_COMMAND_LINE_H_
#define ANICODEC_TOOLS_COMMANDS_COMMAND_LINE_H_

namespace anicodec::tools {

/// Does what the command line asks and returns the exit status. Every error ends here, as one line
/// on stderr. leaves_stages: stages of USD in the folder of a batch are no clips; the Python package
/// encodes them itself.
int run_command_line(int argc, const char* const* argv, bool leaves_stages = false);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_COMMANDS_COMMAND_LINE_H_
