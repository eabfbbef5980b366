// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_names.h"

#include <algorithm>
#include <cstdint>

namespace anicodec::tools {
namespace {

bool is_control(char c) {
  return (c >= 0 && c < ' ') || c == 127;
}

std::string fit(std::string_view name) {
  std::string out(name);
  std::ranges::replace_if(
      out, [](char c) { return c == '/' || is_control(c); }, '_');
  return out.empty() ? "unnamed" : out;
}

}  // namespace

std::string AbcNames::unique(std::string_view name) {
  const std::string base = fit(name);
  std::string out = base;
  while (!taken_.insert(out).second)
    out = base + "_" + std::to_string(2 + next_[base]++);
  return out;
}

std::vector<std::string> path_steps(std::string_view name) {
  if (name.find('/') == std::string_view::npos)
    return {fit(name), fit(name) + "Shape"};
  std::vector<std::string> steps;
  while (!name.empty()) {
    const std::string_view step = name.substr(0, name.find('/'));
    if (!step.empty())
      steps.push_back(fit(step));
    name.remove_prefix(std::min(name.size(), step.size() + 1));
  }
  return steps.empty() ? path_steps("unnamed") : steps;
}

std::string metadata_text(std::string_view text) {
  std::string out(text);
  std::ranges::replace_if(
      out, [](char c) { return c == ';' || c == '=' || is_control(c); }, '_');
  return out;
}

}  // namespace anicodec::tools
