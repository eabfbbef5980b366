// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Shared by all commands, each of which has its file, command_NAME.cpp.
#ifndef ANICODEC_TOOLS_PROGRAM_COMMAND_H_
#define ANICODEC_TOOLS_PROGRAM_COMMAND_H_

#include "codec/sequence/error.h"
#include "tools/options/options.h"

#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Values of the options that several commands have.
struct CommonOptions {
  std::string program;  ///< its name, before errors
  bool overwrite = false;
  bool quiet = false;
  int verbosity = 0;
  int threads = 0;    ///< 0: one for every processor
  bool json = false;  ///< results are JSON objects, one a line, failures too
};

/// The common options of a command, beside --help and --version.
enum CommonOption : unsigned {
  kForce = 1,    ///< -f: it writes files
  kQuiet = 2,    ///< -q: it shows progress, or says what it did
  kVerbose = 4,  ///< -v: it can say more
  kThreads = 8,  ///< -j: it computes in threads
  kJson = 16     ///< --json
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

/// A word that every program takes in the place of a command.
struct ProgramWord {
  const char* name;
  const char* usage;  ///< what follows
  const char* text;   ///< one line
};

inline constexpr ProgramWord kProgramWords[] = {
    {"help", "[COMMAND]", "Print the help of the program or of a command"},
    {"version", "", "Print the version"},
    {"manual", "[COMMAND]", "Print a page of the manual"},
    {"completion", "SHELL", "Print the completion for bash, zsh or fish"}};

/// A program of several commands.
struct Program {
  std::string name, description;
  std::string footer;  ///< of its help
  std::function<void(Commands&, CommonOptions&)> declare;
};

/// Does the same for each of several files. One that fails does not stop the others: its error is
/// printed like that of a program, and at the end an Error of the kind of the first is thrown. That
/// of a lone file is thrown as it is.
void run_for_each(const std::vector<std::string>& files, const CommonOptions& common,
                  const std::function<void(const std::string& file)>& run);

/// Prints an error on stderr as one line that begins with the program's name; with --json also an
/// object with "error" and "status" on the standard output.
void print_error(const std::string& text, ErrorKind kind, const CommonOptions& common);

/// Does what the command line asks and returns the exit status, that of the ErrorKind. Every error
/// ends here, as one line on stderr.
int run_program(const Program& program, int argc, const char* const* argv);

void add_encode(Commands& commands, CommonOptions& common);
void add_decode(Commands& commands, CommonOptions& common);
void add_join(Commands& commands, CommonOptions& common);
void add_add(Commands& commands, CommonOptions& common);
void add_remove(Commands& commands, CommonOptions& common);
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
void add_export_vat(Commands& commands, CommonOptions& common);
void add_corpus(Commands& commands, CommonOptions& common);
void add_usd_plugin(Commands& commands, CommonOptions& common);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_PROGRAM_COMMAND_H_
