// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/program/command.h"

#include "codec/parallel/thread_count.h"
#include "codec/sequence/error.h"
#include "tools/options/help_text.h"
#include "tools/options/nearest_word.h"
#include "tools/options/parse_options.h"
#include "tools/program/manual_page.h"
#include "tools/program/print.h"
#include "tools/program/shell_completion.h"
#include "tools/words/version.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <new>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

void print_version(const Program& program) {
  fmt::print("{} {}\n", program.name, version());
}

void print_help(const Program& program, const Commands& commands) {
  fmt::print("Usage: {} COMMAND [options]\n{}\n\nCommands:\n", program.name, program.description);
  for (const Command& command : commands)
    fmt::print("{}", help_row(command.help.name, command.help.description));
  for (const ProgramWord& word : kProgramWords)
    fmt::print("{}", help_row(fmt::format("{} {}", word.name, word.usage), word.text));
  fmt::print("\nOptions:\n{}{}\n{}\n", help_row("-h,--help", "Print this help"),
             help_row("-V,--version", "Print the version"), program.footer);
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
  for (const ProgramWord& word : kProgramWords)
    names.emplace_back(word.name);
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
  const ThreadLimit limit(static_cast<size_t>(std::max(common.threads, 0)));
  command.run();
}

/// Whether the first word is one of these.
bool begins_with(const std::vector<std::string>& words, std::initializer_list<const char*> any) {
  return !words.empty() && std::find(any.begin(), any.end(), words[0]) != any.end();
}

/// The help that "help COMMAND" asks for.
void run_help(const Program& program, Commands& commands, std::vector<std::string> words) {
  if (words.empty())
    return print_help(program, commands);
  const Command& command = take_command(program, commands, words);
  if (!words.empty())
    throw Error(ErrorKind::kUsage, fmt::format("help: '{}' is one argument too many", words[0]));
  print_help(program, commands, command);
}

/// The page of the manual that "manual COMMAND" asks for.
void run_manual(const Program& program, Commands& commands, std::vector<std::string> words) {
  if (words.empty()) {
    fmt::print("{}", manual_page(program, commands));
    return;
  }
  const Command& command = take_command(program, commands, words);
  if (!words.empty())
    throw Error(ErrorKind::kUsage, fmt::format("manual: '{}' is one argument too many", words[0]));
  fmt::print("{}", manual_page(program, command));
}

void run_completion(const Program& program, const Commands& commands,
                    const std::vector<std::string>& words) {
  constexpr Word<Shell> kShells[] = {
      {Shell::kBash, "bash"}, {Shell::kZsh, "zsh"}, {Shell::kFish, "fish"}};
  for (const Word<Shell>& shell : kShells) {
    if (words.size() == 1 && words[0] == shell.text) {
      fmt::print("{}", shell_completion(program, commands, shell.value));
      return;
    }
  }
  throw Error(ErrorKind::kUsage, "completion: one of bash, zsh and fish is required");
}

void parse_and_run(const Program& program, CommonOptions& common, std::vector<std::string> words) {
  Commands commands;
  program.declare(commands, common);
  if (words.empty()) {
    std::string names;
    for (const Command& command : commands)
      names += (names.empty() ? "" : ", ") + std::string(command.help.name);
    throw Error(ErrorKind::kUsage,
                fmt::format("a command is missing: one of {}; see {} --help", names, program.name));
  }
  if (begins_with(words, {"help", "-h", "--help"})) {
    run_help(program, commands, {words.begin() + 1, words.end()});
  } else if (begins_with(words, {"version", "-V", "--version"})) {
    print_version(program);
  } else if (begins_with(words, {"manual"})) {
    run_manual(program, commands, {words.begin() + 1, words.end()});
  } else if (begins_with(words, {"completion"})) {
    run_completion(program, commands, {words.begin() + 1, words.end()});
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
  options.flag("-V,--version", command.asks_version, "Print the version").is_alone = true;
  if (common_options & kForce)
    options.flag("-f,--force", common.overwrite, "Overwrite outputs that exist");
  if (common_options & kQuiet)
    options.flag("-q,--quiet", common.quiet, "Print nothing but errors and what was asked for");
  if (common_options & kVerbose)
    options.count("-v,--verbose", common.verbosity, "Print more");
  if (common_options & kThreads)
    options.number("-j,--threads", common.threads, "N", {1, 1024},
                   "Threads (default: one for every processor)");
  if (common_options & kJson)
    options.flag("--json", common.json, "Print the result as JSON, one object a line");
  options.group("Options");
  return options;
}

void print_error(const std::string& text, ErrorKind kind, const CommonOptions& common) {
  std::string line = text;
  line.erase(line.find_last_not_of(" \n") + 1);
  std::replace(line.begin(), line.end(), '\n', ' ');
  print_line(stderr, "{}: {}", common.program, line);
  if (common.json)
    print_json({{"error", line}, {"status", static_cast<int>(kind)}});
}

void run_for_each(const std::vector<std::string>& files, const CommonOptions& common,
                  const std::function<void(const std::string& file)>& run) {
  if (files.size() == 1)
    return run(files[0]);
  size_t failed = 0;
  std::string first;
  ErrorKind kind = ErrorKind::kInternal;
  for (const std::string& file : files) {
    try {
      run(file);
    } catch (const Error& e) {
      print_error(e.what(), e.kind(), common);
      if (failed++ > 0)
        continue;
      first = file;
      kind = e.kind();
    }
  }
  if (failed > 0)
    throw Error(kind,
                fmt::format("{} of {} files failed, the first is {}", failed, files.size(), first));
}

int run_program(const Program& program, int argc, const char* const* argv) {
  CommonOptions common;
  common.program = program.name;
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  auto failed = [&](const std::string& text, ErrorKind kind) {
    // An error of the command line may come before --json has been read.
    common.json = common.json || std::find(words.begin(), words.end(), "--json") != words.end();
    print_error(text, kind, common);
    return static_cast<int>(kind);
  };
  try {
    parse_and_run(program, common, words);
    return 0;
  } catch (const Error& e) {
    return failed(e.what(), e.kind());
  } catch (const std::bad_alloc&) {
    return failed("not enough memory", ErrorKind::kInternal);
  } catch (const std::exception& e) {
    return failed(fmt::format("internal error: {}", e.what()), ErrorKind::kInternal);
  }
}

}  // namespace anicodec::tools
