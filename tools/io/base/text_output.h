// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_TEXT_OUTPUT_H_
#define ANICODEC_TOOLS_IO_BASE_TEXT_OUTPUT_H_

#include <charconv>
#include <span>
#include <string>

namespace anicodec::tools {

/// Appends the shortest text that reads back to the same number.
template <typename Number>
void append_number(Number x, std::string& out) {
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, x).ptr);
}

/// Appends numbers with a space between them.
inline void append_floats(std::span<const float> numbers, std::string& out) {
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0)
      out += ' ';
    append_number(numbers[i], out);
  }
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_TEXT_OUTPUT_H_
