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

std::vector<std::pair<std::string, std::vector<const Option*>>> options_by_heading(
    const Options& options) {
  std::vector<std::pair<std::string, std::vector<const Option*>>> groups = {{"Arguments", {}}};
  std::vector<const Option*> general;
  for (const Option& option : options.all()) {
    const std::string heading = heading_of(option);
    if (heading == kGeneralGroup) {
      general.push_back(&option);
      continue;
    }
    auto group = std::ranges::find(groups, heading, [](const auto& g) { return g.first; });
    if (group == groups.end())
      group = groups.insert(groups.end(), {heading, {}});
    group->second.push_back(&option);
  }
  groups.emplace_back(kGeneralGroup, std::move(general));
  std::erase_if(groups, [](const auto& group) { return group.second.empty(); });
  return groups;
}

std::string help_text(const Options& options) {
  std::string text;
  for (const auto& [heading, group] : options_by_heading(options)) {
    text += fmt::format("\n{}:\n", heading);
    for (const Option* option : group)
      text += row_of(*option);
  }
  return text;
}

}  // namespace anicodec::tools
