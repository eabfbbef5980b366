// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/number_rows.h"

#include "codec/sequence/error.h"
#include "tools/inputs/clip_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {

std::vector<NumberRow> read_number_rows(const std::string& path) {
  const std::string text = read_bytes(path);
  std::vector<NumberRow> rows;
  size_t line = 0;
  for (size_t begin = 0; begin < text.size();) {
    size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view rest = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    NumberRow row{++line, {}};
    rest = rest.substr(0, rest.find('#'));
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r,"), rest.size()));
      if (rest.empty())
        break;
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r,"));
      rest.remove_prefix(word.size());
      double value = 0;
      const auto [at, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || at != word.data() + word.size() || !std::isfinite(value))
        throw Error(ErrorKind::kInput,
                    fmt::format("{}:{}: '{}' is not a number", path, line, word));
      row.numbers.push_back(value);
    }
    if (!row.numbers.empty())
      rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace anicodec::tools
