// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_WORDS_HELP_FORMAT_H_
#define ANICODEC_TOOLS_WORDS_HELP_FORMAT_H_

#include <string>

#include <CLI/CLI.hpp>

namespace anicodec::tools {

/// The group of the options that every command has: printed last.
inline constexpr const char* kGeneralGroup = "General";

/// Help of one command: usage, what it does, then a line for every option, grouped.
class HelpFormat : public CLI::Formatter {
 public:
  /// What follows the name of the command.
  explicit HelpFormat(std::string usage);

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;

  std::string make_usage(const CLI::App* app, std::string name) const override;

  std::string make_description(const CLI::App* app) const override;

  std::string make_option_opts(const CLI::Option* option) const override;

 private:
  std::string all_groups(const CLI::App* app) const;

  std::string usage_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_HELP_FORMAT_H_
