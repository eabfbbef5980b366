// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/commands/command.h"

#include "codec/sequence/error.h"
#include "tools/io/base/printable.h"
#include "tools/options/help_text.h"
#include "tools/options/nearest_word.h"
#include "tools/options/parse_options.h"
#include "tools/words/version.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

namespace anicodec::tools {
namespace {

/// Prints an error as one line.
void print_error(const Program& program, std::string_view text) {
  std::string line(text);
  line.erase(line.find_last_not_of(" \n") + 1);
  std::replace(line.begin(), line.end(), '\n', ' ');
  fmt::print(stderr, "{}: {}\n", program.name, printable(line));
}

void print_version(const Program& program) {
  fmt::print("{} {}\n", program.name, version());
}

void print_help(const Program& program, const Commands& commands) {
  fmt::print("Usage: {} COMMAND [options]\n{}\n\nCommands:\n", program.name, program.description);
  for (const Command& command : commands)
    fmt::print("{}", help_row(command.help.name, command.help.description));
  fmt::print("\nOptions:\n{}{}\n{}\n", help_row("-h,--help", "Print this help"),
             help_row("--version", "Print the version"), program.footer);
}

void print_help(const Program& program, const Commands& commands, const Command& command) {
  const CommandHelp& help = command.help;
  fmt::print("Usage: {} {} {}\n{}\n", program.name, help.name, help.usage, help.description);
  const std::string prefix = help.name + " ";
  std::string modes;
  for (const Command& other : commands) {
    if (other.help.name.starts_with(prefix))
      modes += help_row(other.help.name.substr(prefix.size()), other.help.description);
  }
  if (!modes.empty())
    fmt::print("\nModes, each with options and --help:\n{}", modes);
  fmt::print("{}", help_text(command.options));
  if (!help.footer.empty())
    fmt::print("\n{}\n", help.footer);
}

[[noreturn]] void fail_unknown(const Program& program, const Commands& commands,
                               const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : commands)
    names.push_back(command.help.name);
  const std::string meant = nearest_word(name, names);
  throw Error(ErrorKind::kUsage,
              fmt::format("there is no command '{}'{}", name,
                          meant.empty() ? fmt::format("; see {} --help", program.name)
                                        : fmt::format("; did you mean {}?", meant)));
}

/// The command that the first words name: one of two words before one of one word. Removes them.
Command& take_command(const Program& program, Commands& commands, std::vector<std::string>& words) {
  for (size_t length = std::min<size_t>(words.size(), 2); length > 0; --length) {
    const std::string name = length == 2 ? words[0] + " " + words[1] : words[0];
    for (Command& command : commands) {
      if (command.help.name != name)
        continue;
      words.erase(words.begin(), words.begin() + static_cast<ptrdiff_t>(length));
      return command;
    }
  }
  fail_unknown(program, commands, words[0]);
}

void run_command(const Program& program, const Commands& commands, Command& command,
                 const CommonOptions& common, const std::vector<std::string>& words) {
  try {
    parse_options(command.options, words);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.help.name, e.what()));
  }
  if (command.asks_help)
    return print_help(program, commands, command);
  if (command.asks_version)
    return print_version(program);
  using tbb::global_control;
  const size_t threads =
      common.threads > 0 ? static_cast<size_t>(common.threads)
                         : global_control::active_value(global_control::max_allowed_parallelism);
  global_control limit(global_control::max_allowed_parallelism, threads);
  command.run();
}

void parse_and_run(const Program& program, std::vector<std::string> words) {
  CommonOptions common;
  Commands commands;
  program.declare(commands, common);
  if (words.empty())
    throw Error(ErrorKind::kUsage,
                fmt::format("a command is missing; see {} --help", program.name));
  if (words[0] == "-h" || words[0] == "--help") {
    print_help(program, commands);
  } else if (words[0] == "--version") {
    print_version(program);
  } else {
    Command& command = take_command(program, commands, words);
    run_command(program, commands, command, common, words);
  }
  if (std::fflush(stdout) != 0)
    throw Error(ErrorKind::kInternal, "the standard output cannot be written");
}

}  // namespace

Options& add_command(Commands& commands, CommonOptions& common, unsigned common_options,
                     CommandHelp help, std::function<void()> run) {
  Command& command = commands.emplace_back();
  command.help = std::move(help);
  command.run = std::move(run);
  Options& options = command.options;
  options.group(kGeneralGroup);
  options.flag("-h,--help", command.asks_help, "Print this help").is_alone = true;
  options.flag("--version", command.asks_version, "Print the version").is_alone = true;
  if (common_options & kForce)
    options.flag("-f,--force", common.overwrite, "Overwrite outputs that exist");
  if (common_options & kQuiet)
    options.flag("-q,--quiet", common.quiet, "Print nothing but errors and what was asked for");
  if (common_options & kVerbose)
    options.count("-v,--verbose", common.verbosity, "Print more");
  if (common_options & kThreads)
    options.number("-j,--threads", common.threads, "N", {1, 1024},
                   "Threads (default: one for every processor)");
  options.group("Options");
  return options;
}

int run_program(const Program& program, int argc, const char* const* argv) {
  try {
    parse_and_run(program, {argv + std::min(argc, 1), argv + argc});
    return 0;
  } catch (const Error& e) {
    print_error(program, e.what());
    return static_cast<int>(e.kind());
  } catch (const std::bad_alloc&) {
    print_error(program, "not enough memory");
  } catch (const std::exception& e) {
    print_error(program, fmt::format("internal error: {}", e.what()));
  }
  return static_cast<int>(ErrorKind::kInternal);
}

}  // namespace anicodec::tools
