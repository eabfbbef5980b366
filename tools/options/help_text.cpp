// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/options/help_text.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr size_t kColumn = 30;  // of the texts, from 0
constexpr size_t kWidth = 100;

/// Breaks a text at blanks into lines, all but the first of which are indented to the column.
std::string wrapped(std::string_view text) {
  std::string out;
  while (text.size() > kWidth - kColumn) {
    const size_t at = text.rfind(' ', kWidth - kColumn);
    if (at == std::string_view::npos)
      break;
    out += fmt::format("{}\n{:{}}", text.substr(0, at), "", kColumn);
    text.remove_prefix(at + 1);
  }
  return out.append(text);
}

std::string row_of(const Option& option) {
  std::string name = option.names;
  if (option.kind == Option::Kind::kArguments)
    name += "...";
  else if (!option.value.empty())
    name += " " + option.value;
  return help_row(name, option.text);
}

std::string heading_of(const Option& option) {
  return option.is_argument() ? "Arguments" : option.group;
}

}  // namespace

std::string help_row(const std::string& name, const std::string& text) {
  const bool fits = name.size() + 4 <= kColumn;
  return fits ? fmt::format("  {:<{}}{}\n", name, kColumn - 2, wrapped(text))
              : fmt::format("  {}\n{:{}}{}\n", name, "", kColumn, wrapped(text));
}

std::string help_text(const Options& options) {
  std::vector<std::string> headings = {"Arguments"};
  for (const Option& option : options.all()) {
    const std::string heading = heading_of(option);
    if (heading != kGeneralGroup &&
        std::find(headings.begin(), headings.end(), heading) == headings.end())
      headings.push_back(heading);
  }
  headings.emplace_back(kGeneralGroup);
  std::string text;
  for (const std::string& heading : headings) {
    std::string rows;
    for (const Option& option : options.all())
      if (heading_of(option) == heading)
        rows += row_of(option);
    if (!rows.empty())
      text += fmt::format("\n{}:\n{}", heading, rows);
  }
  return text;
}

}  // namespace anicodec::tools
