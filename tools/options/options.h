// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The options of a command as data, from which the parser and the help are made.
#ifndef ANICODEC_TOOLS_OPTIONS_OPTIONS_H_
#define ANICODEC_TOOLS_OPTIONS_OPTIONS_H_

#include "tools/words/word_table.h"

#include <concepts>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace anicodec::tools {

/// One option or argument of a command.
struct Option {
  enum class Kind : uint8_t { kArgument, kArguments, kFlag, kValue };

  Kind kind = Kind::kValue;
  std::string names;               ///< "-o,--output"; of an argument its name in the help
  std::string value;               ///< what stands for the value in the help, such as A:B
  std::string text;                ///< one sentence; the help wraps it
  std::string group;               ///< heading in the help
  std::vector<std::string> words;  ///< the only values, if any
  bool is_required = false;
  bool repeats = false;   ///< may be given more than once
  bool is_alone = false;  ///< such as --help: where it is given, nothing else is read or checked
  /// Called with each value in turn, of a flag with an empty text for each time it is given. Throws
  /// Error(kUsage) that names the option.
  std::function<void(const std::string&)> read;

  Option& required() {
    is_required = true;
    return *this;
  }

  bool is_argument() const { return kind == Kind::kArgument || kind == Kind::kArguments; }

  /// The last of the names: "--output".
  std::string long_name() const { return names.substr(names.rfind(',') + 1); }
};

/// Least and largest value of a number, both allowed.
template <typename T>
struct Bounds {
  T least = std::numeric_limits<T>::lowest();
  T largest = std::numeric_limits<T>::max();
};

/// The options of one command. Variables that they write to must outlive the table.
class Options {
 public:
  /// Options declared from here on stand under this heading.
  void group(std::string heading) { group_ = std::move(heading); }

  /// A word without a name, by its place.
  Option& argument(const std::string& name, std::string& value, const std::string& text);

  /// All words without a name that are left.
  Option& arguments(const std::string& name, std::vector<std::string>& values,
                    const std::string& text);

  Option& flag(const std::string& names, bool& value, const std::string& text);

  /// A flag that says more if it is given more than once.
  Option& count(const std::string& names, int& value, const std::string& text);

  /// An option whose value the command reads itself.
  Option& option(const std::string& names, std::string& value, const std::string& word,
                 const std::string& text);

  template <std::integral T>
  Option& number(const std::string& names, T& value, const std::string& word, Bounds<T> bounds,
                 const std::string& text) {
    return whole(names, word, {int64_t{bounds.least}, int64_t{bounds.largest}}, text,
                 [&value](int64_t number) { value = static_cast<T>(number); });
  }

  Option& number(const std::string& names, double& value, const std::string& word,
                 Bounds<double> bounds, const std::string& text);

  /// Numbers separated by commas, which replace the present ones.
  Option& numbers(const std::string& names, std::vector<double>& values, const std::string& word,
                  Bounds<double> bounds, const std::string& text);
  Option& numbers(const std::string& names, std::vector<uint32_t>& values, const std::string& word,
                  Bounds<uint32_t> bounds, const std::string& text);

  /// An option that adds a value each time it is given.
  Option& repeated(const std::string& names, std::vector<std::string>& values,
                   const std::string& word, const std::string& text);

  /// One of a few words.
  template <typename T>
  Option& choice(const std::string& names, T& value, WordTable<T> words, const std::string& text) {
    std::vector<std::string> list;
    for (const Word<T>& word : words)
      list.emplace_back(word.text);
    return one_of(names, std::move(list), text,
                  [&value, words](size_t i) { value = words[i].value; });
  }

  /// At most one of these options may be given; names in full, such as --csv.
  void exclude(std::vector<std::string> names) { excluded_.push_back(std::move(names)); }

  /// Tells each value of the options declared so far, of a flag an empty text, before the option reads it.
  void watch(const std::function<void(const Option&, const std::string&)>& seen);

  const std::deque<Option>& all() const { return options_; }

  const std::vector<std::vector<std::string>>& excluded() const { return excluded_; }

 private:
  Option& add(Option::Kind kind, const std::string& names, const std::string& word,
              const std::string& text, std::function<void(const std::string&)> read);
  Option& whole(const std::string& names, const std::string& word, Bounds<int64_t> bounds,
                const std::string& text, std::function<void(int64_t)> set);
  Option& one_of(const std::string& names, std::vector<std::string> words, const std::string& text,
                 std::function<void(size_t)> set);

  std::string group_ = "Options";
  std::deque<Option> options_;  // references stay valid
  std::vector<std::vector<std::string>> excluded_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_OPTIONS_OPTIONS_H_
