// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_BYTE_ORDER_H_
#define ANICODEC_TOOLS_IO_BASE_BYTE_ORDER_H_

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace anicodec::tools {

/// Number as stored in the given byte order at any address.
template <typename T>
T load(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes, sizeof(T), raw.begin());
  if (order != std::endian::native)
    std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

template <typename T>
void append(T x, std::endian order, std::string& out) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(x);
  if (order != std::endian::native)
    std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_BYTE_ORDER_H_
