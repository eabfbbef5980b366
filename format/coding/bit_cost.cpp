// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/bit_cost.h"

#include "format/compiler.h"

namespace anicodec {
namespace {

constexpr int kTableBits = 10;

/// -log2(x) in 1/65536 for x = (1024 + i) / 2048, i = 0..1024: bit by bit, squaring a 31-bit
/// fraction.
struct Table {
  uint32_t value[(1 << kTableBits) + 1] = {};

  constexpr Table() {
    for (uint32_t i = 0; i < (1u << kTableBits); ++i) {
      uint64_t x = static_cast<uint64_t>((1u << kTableBits) + i) << (31 - kTableBits);  // 1.31
      uint32_t log = 0;
      for (int b = 15; b >= 0; --b) {
        x = (x * x) >> 31;
        if (x >= uint64_t{1} << 32) {
          x >>= 1;
          log |= 1u << b;
        }
      }
      value[i] = kBitCostOne - log;
    }
    value[1 << kTableBits] = 0;
  }
};

constexpr Table kTable{};

}  // namespace

uint32_t bit_cost(uint32_t p) {
  const int exponent = highest_bit(p);
  // p = 2^exponent * m with m in [1, 2); the top kTableBits of the mantissa, rounded.
  const uint32_t m = exponent >= kTableBits
                         ? ((p >> (exponent - kTableBits)) +
                            (exponent > kTableBits ? (p >> (exponent - kTableBits - 1)) & 1 : 0))
                         : p << (kTableBits - exponent);
  return kTable.value[m - (1u << kTableBits)] + static_cast<uint32_t>(15 - exponent) * kBitCostOne;
}

}  // namespace anicodec
