// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_WORDS_CHOICE_H_
#define ANICODEC_TOOLS_WORDS_CHOICE_H_

#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace anicodec::tools {

/// An option that takes one of a few words.
template <typename T>
CLI::Option* add_choice(CLI::App& command, const std::string& name, T& value,
                        const std::vector<std::pair<std::string, T>>& choices,
                        const std::string& description) {
  std::string words;
  for (const auto& choice : choices)
    words += (words.empty() ? "" : "|") + choice.first;
  CLI::Option* option = command.add_option_function<std::string>(
      name,
      [&value, choices, words, name](const std::string& text) {
        for (const auto& [word, meaning] : choices) {
          if (text == word) {
            value = meaning;
            return;
          }
        }
        throw CLI::ValidationError(name, "'" + text + "' is not one of " + words);
      },
      description);
  return option->option_text(words);
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_WORDS_CHOICE_H_
