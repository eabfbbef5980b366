// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/program/manual_page.h"

#include "tools/options/help_text.h"
#include "tools/words/version.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// Text that troff prints as it is, in one or more lines.
std::string plain(std::string_view text) {
  std::string out;
  bool begins_line = true;
  for (char c : text) {
    if (begins_line && (c == '.' || c == '\''))
      out += "\\&";
    begins_line = c == '\n';
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string page_name(const Program& program, const Command& command) {
  std::string name = program.name + "-" + command.help.name;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string head(const std::string& name, const std::string& description) {
  std::string upper = name;
  std::ranges::transform(upper, upper.begin(), [](char c) {
    return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  });
  return fmt::format(".TH \"{}\" 1 \"\" \"anicodec {}\"\n.SH NAME\n{} \\- {}\n", plain(upper),
                     version(), plain(name), plain(description));
}

std::string synopsis(const std::string& name, const std::string& usage) {
  return fmt::format(".SH SYNOPSIS\n.B {}\n{}\n", plain(name), plain(usage));
}

/// Lines as they are: examples and tables are among them.
std::string notes(const std::string& text) {
  return text.empty() ? "" : fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", plain(text));
}

std::string option_row(const Option& option) {
  std::string names = option.names;
  for (size_t at = names.find(','); at != std::string::npos; at = names.find(',', at + 2))
    names.replace(at, 1, ", ");
  std::string row = ".TP\n.B " + plain(names);
  if (option.kind == Option::Kind::kArguments)
    row += "...";
  else if (!option.value.empty() && !option.is_argument())
    row += " \\fI" + plain(option.value) + "\\fR";
  return row + "\n" + plain(option.text) + "\n";
}

}  // namespace

std::string manual_page(const Program& program, const Commands& commands) {
  std::string page = head(program.name, program.description);
  page += synopsis(program.name, "COMMAND [options]");
  page += ".SH COMMANDS\n";
  for (const Command& command : commands)
    page += fmt::format(".TP\n.BR {} (1)\n{}\n", plain(page_name(program, command)),
                        plain(command.help.description));
  for (const ProgramWord& word : kProgramWords)
    page += fmt::format(".TP\n.B {}\n{}\n", plain(fmt::format("{} {}", word.name, word.usage)),
                        plain(word.text));
  return page + notes(program.footer);
}

std::string manual_page(const Program& program, const Command& command) {
  const CommandHelp& help = command.help;
  std::string page = head(page_name(program, command), help.description);
  page += synopsis(program.name + " " + help.name, help.usage);
  page += ".SH OPTIONS\n";
  for (const auto& [heading, options] : options_by_heading(command.options)) {
    page += ".SS " + plain(heading) + "\n";
    for (const Option* option : options)
      page += option_row(*option);
  }
  return page + notes(help.footer) + fmt::format(".SH SEE ALSO\n.BR {} (1)\n", plain(program.name));
}

}  // namespace anicodec::tools
