// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Four rows of symbols whose mean is weighted by how well each foretold the symbols before
// (spec/08-entropy.md, section 5).
#ifndef ANICODEC_FORMAT_CODING_WEIGHTED_ROWS_H_
#define ANICODEC_FORMAT_CODING_WEIGHTED_ROWS_H_

#include "format/coding/symbol_row.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace anicodec {

using FourRows = std::array<SymbolRow*, 4>;

/// The weights of four rows, in 1/32768, together about 1.
struct RowWeights {
  uint16_t w[4] = {8192, 8192, 8192, 8192};
};

/// The distribution of four rows.
class WeightedDistribution {
 public:
  WeightedDistribution(const FourRows& rows, const RowWeights& weights) {
    starts_[0] = 0;
    VectorRows::mix(rows.data(), weights.w, starts_ + 1);
  }

  uint32_t start(uint32_t s) const { return starts_[s]; }

  uint32_t at(uint32_t x) const { return VectorRows::find(starts_ + 1, x); }

 private:
  uint16_t starts_[kRowSymbols + 1];
};

/// Moves the weight of a row along the gradient of what the symbol took: `part` is the symbol's in 1/32768
/// by that row, `unit` 2^24 over that by all of them.
inline uint32_t moved_weight(uint32_t weight, uint32_t part, uint64_t unit) {
  constexpr int kOne = 256;
  const int gain = static_cast<int>(std::min<uint64_t>(part * unit >> 16, 4 * kOne - 1)) - kOne;
  const int w = static_cast<int>(weight);
  return static_cast<uint32_t>(std::max(w + ((w * gain) >> 12), 512));
}

/// Codes a symbol by four rows, which learn from it, as their weights do.
template <class Coder>
inline uint32_t code_weighted_symbol(Coder& coder, const FourRows& rows, RowWeights& weights,
                                     uint32_t s) {
  const WeightedDistribution distribution(rows, weights);
  s = coder.symbol(distribution, s);
  if constexpr (Coder::kAdapts) {
    const uint64_t unit = (1U << 24) / (distribution.start(s + 1) - distribution.start(s));
    uint32_t moved[4], sum = 0;
    for (size_t k = 0; k < 4; ++k) {
      SymbolRow& row = *rows[k];
      const uint32_t end = s == kRowEscape ? kSymbolScale : row.v[s];
      moved[k] = moved_weight(weights.w[k], end - (s > 0 ? row.v[s - 1] : 0U), unit);
      sum += moved[k];
      VectorRows::learn(row, s);
    }
    const uint32_t scale = (1U << 30) / sum;
    for (size_t k = 0; k < 4; ++k)
      weights.w[k] = static_cast<uint16_t>(moved[k] * scale >> 15);
  }
  return s;
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_WEIGHTED_ROWS_H_
