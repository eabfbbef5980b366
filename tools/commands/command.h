// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// What all commands share. Each has a file of its own, command_NAME.cpp.
#ifndef ANICODEC_TOOLS_COMMANDS_COMMAND_H_
#define ANICODEC_TOOLS_COMMANDS_COMMAND_H_

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace anicodec::tools {

/// Options of every command.
struct CommonOptions {
  bool overwrite = false;
  bool quiet = false;
  int verbosity = 0;
  int threads = 0;  ///< 0: one for every processor
};

/// Texts of a command's help.
struct CommandHelp {
  std::string name;
  std::string usage;        ///< what follows the name
  std::string description;  ///< one line
  std::string footer;       ///< examples and anything that needs more words
};

/// Adds a command with the common options; `run` is called when it is the one asked for.
CLI::App* add_command(CLI::App& app, CommonOptions& common, const CommandHelp& help,
                      std::function<void()> run);

void add_encode(CLI::App& app, CommonOptions& common);
void add_decode(CLI::App& app, CommonOptions& common);
void add_join(CLI::App& app, CommonOptions& common);
void add_info(CLI::App& app, CommonOptions& common);
void add_verify(CLI::App& app, CommonOptions& common);
void add_compare(CLI::App& app, CommonOptions& common);
void add_analyze(CLI::App& app, CommonOptions& common);
void add_interpolate(CLI::App& app, CommonOptions& common);
void add_massage(CLI::App& app, CommonOptions& common);
void add_dump(CLI::App& app, CommonOptions& common);
void add_render(CLI::App& app, CommonOptions& common);
void add_corpus(CLI::App& app, CommonOptions& common);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_COMMANDS_COMMAND_H_
