// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/help_format.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace anicodec::tools {

HelpFormat::HelpFormat(std::string usage) : usage_(std::move(usage)) {
  column_width(30);
}

std::string HelpFormat::make_help(const CLI::App* app, std::string name,
                                  CLI::AppFormatMode mode) const {
  return make_usage(app, std::move(name)) + make_description(app) + all_groups(app) +
         make_subcommands(app, mode) + make_footer(app);
}

std::string HelpFormat::all_groups(const CLI::App* app) const {
  auto group = [&](const std::string& title, bool positional, auto belongs) {
    std::vector<const CLI::Option*> options = app->get_options([&](const CLI::Option* option) {
      return option->get_positional() == positional && belongs(option);
    });
    std::string text = options.empty() ? "" : make_group(title, positional, options);
    text.erase(text.find_last_not_of('\n') + 1);
    return text.empty() ? text : text + "\n";
  };
  std::string text = group("Arguments", true, [](const CLI::Option*) { return true; });
  std::vector<std::string> titles = app->get_groups();
  std::stable_partition(titles.begin(), titles.end(),
                        [](const std::string& title) { return title != kGeneralGroup; });
  for (const std::string& title : titles)
    text += group(title, false, [&](const CLI::Option* o) { return o->get_group() == title; });
  return text;
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  if (option->get_positional())
    return option->get_expected_max() > 1 ? "..." : "";
  return CLI::Formatter::make_option_opts(option);
}

std::string HelpFormat::make_usage(const CLI::App* app, std::string) const {
  std::string name = app->get_name();
  for (const CLI::App* parent = app->get_parent(); parent; parent = parent->get_parent())
    name = parent->get_name() + " " + name;
  return "Usage: " + name + " " + usage_ + "\n";
}

std::string HelpFormat::make_description(const CLI::App* app) const {
  return app->get_description() + "\n";
}

}  // namespace anicodec::tools
