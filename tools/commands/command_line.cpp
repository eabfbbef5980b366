// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/commands/command_line.h"

#include "codec/sequence/error.h"
#include "tools/commands/command.h"
#include "tools/io/base/printable.h"
#include "tools/io/files/cleanup.h"
#include "tools/options/help_text.h"
#include "tools/options/nearest_word.h"
#include "tools/options/parse_options.h"
#include "tools/words/version.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

namespace anicodec::tools {
namespace {

constexpr const char* kFooter = R"(
Examples:
  anicodec encode dance.obj dance.pc2 -o dance.anic
  anicodec encode 'frames/*.obj' -o clip.anic --kg 0.1
  anicodec decode clip.anic -o clip.pc2
  anicodec compare 'frames/*.obj' clip.anic

Exit status:
  0  done
  1  impossible options, or an output that exists (without -f)
  2  input that cannot be read or encoded
  3  a damaged .anic file
  4  a file or feature that this build does not support
  5  an internal error, no memory, or a full disk
'anicodec COMMAND --help' explains a command.)";

/// Prints an error as one line.
void print_error(std::string_view text) {
  std::string line(text);
  line.erase(line.find_last_not_of(" \n") + 1);
  std::replace(line.begin(), line.end(), '\n', ' ');
  fmt::print(stderr, "anicodec: {}\n", printable(line));
}

int status_of(ErrorKind kind) {
  return static_cast<int>(kind);
}

Commands all_commands(CommonOptions& common) {
  Commands commands;
  for (auto add : {add_encode, add_decode, add_join, add_info, add_verify, add_compare, add_analyze,
                   add_interpolate, add_massage, add_massage_fit, add_massage_transfer,
                   add_massage_map, add_massage_remesh, add_dump, add_render, add_corpus})
    add(commands, common);
  return commands;
}

void print_version() {
  fmt::print("anicodec {}\n", version());
}

void print_help(const Commands& commands) {
  fmt::print(
      "Usage: anicodec COMMAND [options]\n"
      "Makes animated meshes small: encodes baked mesh sequences to .anic and back.\n\n"
      "Commands:\n");
  for (const Command& command : commands)
    fmt::print("{}", help_row(command.help.name, command.help.description));
  fmt::print("\nOptions:\n{}{}{}\n", help_row("-h,--help", "Print this help"),
             help_row("--version", "Print the version"), kFooter);
}

void print_help(const Commands& commands, const Command& command) {
  const CommandHelp& help = command.help;
  fmt::print("Usage: anicodec {} {}\n{}\n", help.name, help.usage, help.description);
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

[[noreturn]] void fail_unknown(const Commands& commands, const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : commands)
    names.push_back(command.help.name);
  const std::string meant = nearest_word(name, names);
  throw Error(ErrorKind::kUsage,
              fmt::format("there is no command '{}'{}", name,
                          meant.empty() ? "; see anicodec --help"
                                        : fmt::format("; did you mean {}?", meant)));
}

/// The command that the first words name: one of two words before one of one word. Removes them.
Command& take_command(Commands& commands, std::vector<std::string>& words) {
  for (size_t length = std::min<size_t>(words.size(), 2); length > 0; --length) {
    const std::string name = length == 2 ? words[0] + " " + words[1] : words[0];
    for (Command& command : commands) {
      if (command.help.name != name)
        continue;
      words.erase(words.begin(), words.begin() + static_cast<ptrdiff_t>(length));
      return command;
    }
  }
  fail_unknown(commands, words[0]);
}

void run_command(const Commands& commands, Command& command, const CommonOptions& common,
                 const std::vector<std::string>& words) {
  try {
    parse_options(command.options, words);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("{}: {}", command.help.name, e.what()));
  }
  if (command.asks_help)
    return print_help(commands, command);
  if (command.asks_version)
    return print_version();
  using tbb::global_control;
  const size_t threads =
      common.threads > 0 ? static_cast<size_t>(common.threads)
                         : global_control::active_value(global_control::max_allowed_parallelism);
  global_control limit(global_control::max_allowed_parallelism, threads);
  command.run();
}

void parse_and_run(std::vector<std::string> words) {
  CommonOptions common;
  Commands commands = all_commands(common);
  if (words.empty())
    throw Error(ErrorKind::kUsage, "a command is missing; see anicodec --help");
  if (words[0] == "-h" || words[0] == "--help") {
    print_help(commands);
  } else if (words[0] == "--version") {
    print_version();
  } else {
    Command& command = take_command(commands, words);
    run_command(commands, command, common, words);
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

int run_command_line(int argc, const char* const* argv) {
  install_cleanup_on_signal();
  try {
    parse_and_run({argv + std::min(argc, 1), argv + argc});
    return 0;
  } catch (const Error& e) {
    print_error(e.what());
    return status_of(e.kind());
  } catch (const std::bad_alloc&) {
    print_error("not enough memory");
  } catch (const std::exception& e) {
    print_error(fmt::format("internal error: {}", e.what()));
  }
  return status_of(ErrorKind::kInternal);
}

}  // namespace anicodec::tools
