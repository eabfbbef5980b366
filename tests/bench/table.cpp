// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/bench/table.h"

#include "tools/words/quantity.h"

#include <algorithm>

#include <fmt/format.h>

namespace anicodec::bench {
namespace {

/// Escapes bars, which would end a cell of Markdown.
std::string escaped(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

std::string cell(const nlohmann::ordered_json& row, const Table::Column& column) {
  auto value = row.find(column.key);
  if (value == row.end() || value->is_null())
    return "-";
  if (value->is_string())
    return escaped(value->get<std::string>());
  if (!value->is_number())
    return value->dump();
  if (!column.format.empty())
    return fmt::format(fmt::runtime(column.format), value->get<double>());
  return value->is_number_integer() ? tools::grouped(value->get<uint64_t>()) : value->dump();
}

}  // namespace

std::string Table::print(TableStyle style) const {
  std::string out;
  if (style == TableStyle::kCsv) {
    for (size_t c = 0; c < columns_.size(); ++c)
      out += (c ? "," : "") + columns_[c].key;
    out += '\n';
    for (const auto& row : rows_) {
      for (size_t c = 0; c < columns_.size(); ++c) {
        auto value = row.find(columns_[c].key);
        out += c ? "," : "";
        if (value != row.end() && !value->is_null())
          out += value->is_string() ? value->get<std::string>() : value->dump();
      }
      out += '\n';
    }
    return out;
  }
  std::vector<std::vector<std::string>> cells;
  std::vector<size_t> widths;
  for (const Column& column : columns_) {
    std::vector<std::string> texts{column.heading};
    for (const auto& row : rows_)
      texts.push_back(cell(row, column));
    widths.push_back(std::ranges::max(texts, {}, &std::string::size).size());
    cells.push_back(std::move(texts));
  }
  for (size_t r = 0; r <= rows_.size(); ++r) {
    for (size_t c = 0; c < cells.size(); ++c)
      out += fmt::format("| {:>{}} ", cells[c][r], widths[c]);
    out += "|\n";
    for (size_t c = 0; r == 0 && c < cells.size(); ++c)
      out += fmt::format("|{:->{}}:", "", widths[c] + 1);
    out += r == 0 ? "|\n" : "";
  }
  return out;
}

}  // namespace anicodec::bench
