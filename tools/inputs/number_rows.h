// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_NUMBER_ROWS_H_
#define ANICODEC_TOOLS_INPUTS_NUMBER_ROWS_H_

#include <cstddef>
#include <string>
#include <vector>

namespace anicodec::tools {

struct NumberRow {
  size_t line;  ///< from 1
  std::vector<double> numbers;
};

/// The lines of a text file that hold numbers, separated by blanks or commas; # begins a comment.
/// Throws Error(kInput) naming the line of what is no finite number.
std::vector<NumberRow> read_number_rows(const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_NUMBER_ROWS_H_
