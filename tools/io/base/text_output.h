// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_TEXT_OUTPUT_H_
#define ANICODEC_TOOLS_IO_BASE_TEXT_OUTPUT_H_

#include "codec/sequence/mesh_sequence.h"

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

/// Appends a position that counts from a local origin, with a space between its numbers.
inline void append_position(const float* position, const Point& origin, std::string& out) {
  for (size_t k = 0; k < 3; ++k) {
    if (k > 0)
      out += ' ';
    if (origin[k] == 0)
      append_number(position[k], out);
    else
      append_number(origin[k] + static_cast<double>(position[k]), out);
  }
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
