// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/options/options.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// Reads a number within bounds that fills the whole text.
template <typename T>
T parse_number(const std::string& name, const std::string& text, Bounds<T> bounds,
               const char* kind) {
  T number{};
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number);
  bool good = error == std::errc() && at == end;
  if constexpr (std::floating_point<T>)
    good = good && std::isfinite(number);
  if (good && number >= bounds.least && number <= bounds.largest)
    return number;
  const std::string range = bounds.largest == std::numeric_limits<T>::max()
                                ? ""
                                : fmt::format(" from {} to {}", bounds.least, bounds.largest);
  throw Error(ErrorKind::kUsage, fmt::format("{}: '{}' is not a {}{}", name, text, kind, range));
}

std::string long_name_of(const std::string& names) {
  return names.substr(names.rfind(',') + 1);
}

template <typename T>
std::function<void(const std::string&)> list_reader(const std::string& names,
                                                    std::vector<T>& values, Bounds<T> bounds) {
  return [&values, bounds, name = long_name_of(names)](const std::string& given) {
    values.clear();
    for (size_t begin = 0; begin <= given.size();) {
      const size_t end = std::min(given.find(',', begin), given.size());
      values.push_back(parse_number(name, given.substr(begin, end - begin), bounds,
                                    std::integral<T> ? "whole number" : "number"));
      begin = end + 1;
    }
  };
}

}  // namespace

Option& Options::add(Option::Kind kind, const std::string& names, const std::string& word,
                     const std::string& text, std::function<void(const std::string&)> read) {
  Option& option = options_.emplace_back();
  option.kind = kind;
  option.names = names;
  option.value = word;
  option.text = text;
  option.group = group_;
  option.read = std::move(read);
  return option;
}

Option& Options::argument(const std::string& name, std::string& value, const std::string& text) {
  return add(Option::Kind::kArgument, name, "", text,
             [&value](const std::string& given) { value = given; });
}

Option& Options::arguments(const std::string& name, std::vector<std::string>& values,
                           const std::string& text) {
  return add(Option::Kind::kArguments, name, "", text,
             [&values](const std::string& given) { values.push_back(given); });
}

Option& Options::flag(const std::string& names, bool& value, const std::string& text) {
  return add(Option::Kind::kFlag, names, "", text, [&value](const std::string&) { value = true; });
}

Option& Options::count(const std::string& names, int& value, const std::string& text) {
  return add(Option::Kind::kFlag, names, "", text, [&value](const std::string&) { ++value; });
}

Option& Options::option(const std::string& names, std::string& value, const std::string& word,
                        const std::string& text) {
  return add(Option::Kind::kValue, names, word, text,
             [&value](const std::string& given) { value = given; });
}

Option& Options::number(const std::string& names, double& value, const std::string& word,
                        Bounds<double> bounds, const std::string& text) {
  return add(Option::Kind::kValue, names, word, text,
             [&value, bounds, name = long_name_of(names)](const std::string& given) {
               value = parse_number(name, given, bounds, "number");
             });
}

Option& Options::numbers(const std::string& names, std::vector<double>& values,
                         const std::string& word, Bounds<double> bounds, const std::string& text) {
  return add(Option::Kind::kValue, names, word, text, list_reader(names, values, bounds));
}

Option& Options::numbers(const std::string& names, std::vector<uint32_t>& values,
                         const std::string& word, Bounds<uint32_t> bounds,
                         const std::string& text) {
  return add(Option::Kind::kValue, names, word, text, list_reader(names, values, bounds));
}

Option& Options::repeated(const std::string& names, std::vector<std::string>& values,
                          const std::string& word, const std::string& text) {
  Option& option = add(Option::Kind::kValue, names, word, text,
                       [&values](const std::string& given) { values.push_back(given); });
  option.repeats = true;
  return option;
}

Option& Options::whole(const std::string& names, const std::string& word, Bounds<int64_t> bounds,
                       const std::string& text, std::function<void(int64_t)> set) {
  return add(Option::Kind::kValue, names, word, text,
             [bounds, set = std::move(set), name = long_name_of(names)](const std::string& given) {
               set(parse_number(name, given, bounds, "whole number"));
             });
}

Option& Options::one_of(const std::string& names, std::vector<std::string> words,
                        const std::string& text, std::function<void(size_t)> set) {
  const std::string list = fmt::format("{}", fmt::join(words, "|"));
  Option& option = add(
      Option::Kind::kValue, names, list, text,
      [words, list, set = std::move(set), name = long_name_of(names)](const std::string& given) {
        const auto found = std::find(words.begin(), words.end(), given);
        if (found == words.end())
          throw Error(ErrorKind::kUsage,
                      fmt::format("{}: '{}' is not one of {}", name, given, list));
        set(static_cast<size_t>(found - words.begin()));
      });
  option.words = std::move(words);
  return option;
}

void Options::watch(const std::function<void(const Option&, const std::string&)>& seen) {
  for (Option& option : options_) {
    option.read = [&option, seen, read = option.read](const std::string& value) {
      seen(option, value);
      read(value);
    };
  }
}

}  // namespace anicodec::tools
