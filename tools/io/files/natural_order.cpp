// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/natural_order.h"

#include <algorithm>

namespace anicodec::tools {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes the run of digits or the single other character that comes first.
std::string_view take_piece(std::string_view& text) {
  size_t size = 1;
  if (is_digit(text[0]))
    size = static_cast<size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  std::string_view piece = text.substr(0, size);
  text.remove_prefix(size);
  return piece;
}

std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  std::string_view rest_a = a, rest_b = b;
  int zeros = 0;  // of the first numbers that differ in nothing else
  while (!rest_a.empty() && !rest_b.empty()) {
    std::string_view x = take_piece(rest_a), y = take_piece(rest_b);
    if (is_digit(x[0]) && is_digit(y[0])) {
      std::string_view p = without_zeros(x), q = without_zeros(y);
      if (p.size() != q.size())
        return p.size() < q.size();
      if (p != q)
        return p < q;
      if (zeros == 0 && x.size() != y.size())
        zeros = x.size() < y.size() ? -1 : 1;
    } else if (x[0] != y[0]) {
      return x < y;
    }
  }
  if (rest_a.empty() != rest_b.empty())
    return rest_a.empty();
  return zeros < 0;
}

}  // namespace anicodec::tools
