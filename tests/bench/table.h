// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_TABLE_H_
#define ANICODEC_TESTS_BENCH_TABLE_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::bench {

enum class TableStyle { kText, kCsv, kJson };

/// Rows of named values, printed in one of three ways. A value may be missing in some rows.
class Table {
 public:
  struct Column {
    std::string key;      ///< in JSON and CSV
    std::string heading;  ///< in text
    std::string format;   ///< of {fmt} for numbers, such as "{:.2f}"; integers are grouped if empty
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// One object with values by the keys of the columns; other keys are shown in JSON only.
  void add(nlohmann::ordered_json row) { rows_.push_back(std::move(row)); }

  bool empty() const { return rows_.empty(); }

  const nlohmann::ordered_json& rows() const { return rows_; }

  /// As text (a table of Markdown) or CSV.
  std::string print(TableStyle style) const;

 private:
  std::vector<Column> columns_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_TABLE_H_
