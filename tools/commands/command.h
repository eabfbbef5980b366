// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// What all commands share. Each has a file of its own, command_NAME.cpp.
#ifndef ANICODEC_TOOLS_COMMANDS_COMMAND_H_
#define ANICODEC_TOOLS_COMMANDS_COMMAND_H_

#include "tools/options/options.h"

#include <deque>
#include <functional>
#include <string>

namespace anicodec::tools {

/// Values of the options that several commands have.
struct CommonOptions {
  bool overwrite = false;
  bool quiet = false;
  int verbosity = 0;
  int threads = 0;  ///< 0: one for every processor
};

/// The common options of a command, beside --help and --version.
enum CommonOption : unsigned {
  kForce = 1,    ///< -f: it writes files
  kQuiet = 2,    ///< -q: it shows progress, or says what it did
  kVerbose = 4,  ///< -v: it can say more
  kThreads = 8   ///< -j: it computes in threads
};

/// Texts of a command's help.
struct CommandHelp {
  std::string name;         ///< "encode", or of a command's mode "massage fit"
  std::string usage;        ///< what follows the name
  std::string description;  ///< one line
  std::string footer;       ///< examples and anything that needs more words
};

struct Command {
  CommandHelp help;
  Options options;
  std::function<void()> run;
  bool asks_help = false;  ///< --help is given
  bool asks_version = false;
};

/// All commands; references stay valid.
using Commands = std::deque<Command>;

/// Adds a command with some of the common options, for more to be declared; `run` is called when it
/// is the one asked for.
Options& add_command(Commands& commands, CommonOptions& common, unsigned common_options,
                     CommandHelp help, std::function<void()> run);

/// A program of several commands.
struct Program {
  std::string name, description;
  std::string footer;  ///< of its help
  std::function<void(Commands&, CommonOptions&)> declare;
};

/// Does what the command line asks and returns the exit status, that of the ErrorKind. Every error
/// ends here, as one line on stderr.
int run_program(const Program& program, int argc, const char* const* argv);

void add_encode(Commands& commands, CommonOptions& common);
void add_decode(Commands& commands, CommonOptions& common);
void add_join(Commands& commands, CommonOptions& common);
void add_info(Commands& commands, CommonOptions& common);
void add_verify(Commands& commands, CommonOptions& common);
void add_compare(Commands& commands, CommonOptions& common);
void add_analyze(Commands& commands, CommonOptions& common);
void add_interpolate(Commands& commands, CommonOptions& common);
void add_massage(Commands& commands, CommonOptions& common);
void add_massage_fit(Commands& commands, CommonOptions& common);
void add_massage_remesh(Commands& commands, CommonOptions& common);
void add_massage_transfer(Commands& commands, CommonOptions& common);
void add_massage_map(Commands& commands, CommonOptions& common);
void add_dump(Commands& commands, CommonOptions& common);
void add_render(Commands& commands, CommonOptions& common);
void add_corpus(Commands& commands, CommonOptions& common);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_COMMANDS_COMMAND_H_
