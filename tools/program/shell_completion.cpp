// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/program/shell_completion.h"

#include "tools/words/word_list.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace anicodec::tools {
namespace {

/// In single quotes; the characters of `escaped` after a backslash.
std::string in_quotes(std::string_view text, std::string_view escaped = "") {
  std::string out = "'";
  for (char c : text) {
    if (c == '\'')
      out += "'\\'";
    else if (escaped.find(c) != std::string_view::npos)
      out += '\\';
    out += c;
  }
  return out + "'";
}

/// Names of commands, or of the modes of one: what may follow `before`.
std::vector<std::string> next_words(const Commands& commands, const std::string& before) {
  std::vector<std::string> words;
  const std::string prefix = before.empty() ? "" : before + " ";
  for (const Command& command : commands) {
    const std::string& name = command.help.name;
    if (name.starts_with(prefix) && name.find(' ', prefix.size()) == std::string::npos)
      words.push_back(name.substr(prefix.size()));
  }
  return words;
}

/// The modes of a command, or the words that its argument may be.
std::vector<std::string> following_words(const Commands& commands, const Command& command) {
  std::vector<std::string> words = next_words(commands, command.help.name);
  for (const Option& option : command.options.all()) {
    if (option.is_argument())
      words.insert(words.end(), option.words.begin(), option.words.end());
  }
  return words;
}

bool is_mode(const Command& command) {
  return command.help.name.find(' ') != std::string::npos;
}

/// Commands of two words, which the scripts look for first.
std::string mode_patterns(const Commands& commands) {
  std::vector<std::string> modes;
  for (const Command& command : commands) {
    if (is_mode(command))
      modes.push_back(in_quotes(command.help.name));
  }
  return fmt::format("{}", fmt::join(modes, "|"));
}

std::string bash(const Program& program, const Commands& commands) {
  std::string values, options;
  for (const Command& command : commands) {
    std::vector<std::string> words = following_words(commands, command);
    for (const Option& option : command.options.all()) {
      if (option.is_argument())
        continue;
      const std::vector<std::string> names = split_at_commas(option.names);
      words.insert(words.end(), names.begin(), names.end());
      if (option.kind != Option::Kind::kValue)
        continue;
      std::vector<std::string> cases;
      for (const std::string& name : names)
        cases.push_back(in_quotes(command.help.name + ":" + name));
      values += fmt::format("    {}) words={} ;;\n", fmt::join(cases, "|"),
                            in_quotes(fmt::format("{}", fmt::join(option.words, " "))));
    }
    options += fmt::format("        {}) words={} ;;\n", in_quotes(command.help.name),
                           in_quotes(fmt::format("{}", fmt::join(words, " "))));
  }
  std::string script = fmt::format(R"(# Completion of {0} for bash.
_{0}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command=${{COMP_WORDS[1]}} words=
)",
                                   program.name);
  std::vector<std::string> first = next_words(commands, "");
  for (const ProgramWord& word : kProgramWords)
    first.emplace_back(word.name);
  if (const std::string modes = mode_patterns(commands); !modes.empty())
    script += fmt::format(R"(  if ((COMP_CWORD > 2)); then
    case "$command ${{COMP_WORDS[2]}}" in
      {}) command+=" ${{COMP_WORDS[2]}}" ;;
    esac
  fi
)",
                          modes);
  return script + fmt::format(R"(  if ((COMP_CWORD == 1)); then
    words='{1}'
  else
    case "$command:$before" in
{2}    *)
      case "$command" in
{3}      esac ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _{0} {0}
)",
                              program.name, fmt::join(first, " "), values, options);
}

/// An option as _arguments takes it.
std::string zsh_argument(const Option& option) {
  constexpr std::string_view kSpecial = "[]:\\";
  const std::vector<std::string> names = split_at_commas(option.names);
  std::string value;
  if (option.kind == Option::Kind::kValue)
    value = option.words.empty()
                ? in_quotes(":" + option.value, "\\") + in_quotes(":_files")
                : in_quotes(":word:(" + fmt::format("{}", fmt::join(option.words, " ")) + ")");
  std::string rows;
  for (const std::string& name : names)
    rows += fmt::format(
        "      {}{}{}{} \\\n",
        option.repeats ? "'*'" : in_quotes("(" + fmt::format("{}", fmt::join(names, " ")) + ")"),
        name, in_quotes("[") + in_quotes(option.text, kSpecial) + in_quotes("]"), value);
  return rows;
}

std::string zsh(const Program& program, const Commands& commands) {
  std::string cases, described;
  for (const Command& command : commands) {
    std::string rows;
    for (const Option& option : command.options.all()) {
      if (!option.is_argument())
        rows += zsh_argument(option);
    }
    const std::vector<std::string> modes = following_words(commands, command);
    const std::string rest =
        modes.empty()
            ? "'*:file:_files'"
            : in_quotes(fmt::format("1:mode:({})", fmt::join(modes, " "))) + " '*:file:_files'";
    cases += fmt::format("    {}) _arguments -s \\\n{}      {} ;;\n", in_quotes(command.help.name),
                         rows, rest);
    if (!is_mode(command))
      described +=
          fmt::format("    {}\n", in_quotes(command.help.name + ":" + command.help.description));
  }
  for (const ProgramWord& word : kProgramWords)
    described += fmt::format("    {}\n", in_quotes(fmt::format("{}:{}", word.name, word.text)));
  std::string modes = mode_patterns(commands);
  return fmt::format(R"(#compdef {0}
# Completion of {0} for zsh.
_{0}() {{
  local -a commands=(
{1}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  integer skip=1
  case "$command $words[3]" in
    {2}) ((CURRENT > 3)) && command+=" $words[3]" && skip=2 ;;
  esac
  shift $skip words
  ((CURRENT -= skip))
  case $command in
{3}  esac
}}
_{0} "$@"
)",
                     program.name, described, modes.empty() ? "''" : modes, cases);
}

std::string fish(const Program& program, const Commands& commands) {
  std::string script = fmt::format("# Completion of {} for fish.\n", program.name);
  const std::string start = fmt::format("complete -c {}", program.name);
  const auto add_word = [&](const std::string& name, const std::string& text) {
    script += fmt::format("{} -n __fish_use_subcommand -a {} -d {}\n", start, in_quotes(name),
                          in_quotes(text));
  };
  for (const ProgramWord& word : kProgramWords)
    add_word(word.name, word.text);
  for (const Command& command : commands) {
    const std::string& name = command.help.name;
    const size_t blank = name.find(' ');
    const std::string first = name.substr(0, blank);
    std::string when = "__fish_seen_subcommand_from " + first;
    if (blank == std::string::npos) {
      add_word(name, command.help.description);
      const std::vector<std::string> modes = next_words(commands, name);
      if (!modes.empty())
        when += "; and not __fish_seen_subcommand_from " + fmt::format("{}", fmt::join(modes, " "));
    } else {
      const std::string mode = name.substr(blank + 1);
      script += fmt::format("{} -n {} -a {} -d {}\n", start, in_quotes(when), in_quotes(mode),
                            in_quotes(command.help.description));
      when += "; and __fish_seen_subcommand_from " + mode;
    }
    for (const Option& option : command.options.all()) {
      if (option.is_argument() && !option.words.empty())
        script += fmt::format("{} -n {} -xa {}\n", start, in_quotes(when),
                              in_quotes(fmt::format("{}", fmt::join(option.words, " "))));
      if (option.is_argument())
        continue;
      script += start + " -n " + in_quotes(when);
      for (const std::string& spelling : split_at_commas(option.names))
        script +=
            spelling.starts_with("--") ? " -l " + spelling.substr(2) : " -s " + spelling.substr(1);
      if (option.kind == Option::Kind::kValue)
        script += option.words.empty()
                      ? " -r"
                      : " -xa " + in_quotes(fmt::format("{}", fmt::join(option.words, " ")));
      script += " -d " + in_quotes(option.text) + "\n";
    }
  }
  return script;
}

}  // namespace

std::string shell_completion(const Program& program, const Commands& commands, Shell shell) {
  switch (shell) {
    case Shell::kBash:
      return bash(program, commands);
    case Shell::kZsh:
      return zsh(program, commands);
    case Shell::kFish:
      break;
  }
  return fish(program, commands);
}

}  // namespace anicodec::tools
