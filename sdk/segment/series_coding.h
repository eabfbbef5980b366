// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Integers that change smoothly over the frames: rigid motions (spec/08-entropy.md). Written once
// for encoder and decoder.
#ifndef ANICODEC_SDK_SEGMENT_SERIES_CODING_H_
#define ANICODEC_SDK_SEGMENT_SERIES_CODING_H_

#include "format/coding/binary_coder.h"
#include "format/coding/symbol_model.h"
#include "format/memory.h"

#include <cstdint>
#include <cstdlib>

namespace anicodec {

/// Models shared by all series of a stream.
class SeriesCoding {
 public:
  static constexpr int32_t kLimit = 1 << 28;

  /// Codes `count` integers, each less than kLimit in magnitude, by their differences from the
  /// extrapolation of polynomial order 0, 1 or 2; an encoder passes the order that suits best.
  /// False when the stream ran out or a value passes the limit.
  template <class Coder>
  bool code(Coder& coder, size_t count, int32_t order, Vector<int32_t>* values) {
    order = order_.code(coder, order);
    if (order > 2)
      return false;
    if constexpr (Coder::kDecodes)
      values->assign(count, 0);
    uint32_t context = 12;
    for (size_t f = 0; f < count; ++f) {
      int64_t predicted = extrapolated(*values, f, order);
      int64_t residual = int64_t{(*values)[f]} - predicted;
      if (residual < -4 * int64_t{kLimit} || residual > 4 * int64_t{kLimit})
        return false;
      residual = residual_[context].code(coder, static_cast<int32_t>(residual));
      int64_t value = predicted + residual;
      if (value <= -kLimit || value >= kLimit)
        return false;
      (*values)[f] = static_cast<int32_t>(value);
      auto magnitude = static_cast<uint32_t>(std::llabs(residual));
      uint32_t width = magnitude == 0 ? 0 : 1 + static_cast<uint32_t>(floor_log2(magnitude));
      context = (context + (width < 12 ? width : 12) + 1) / 2;
      if constexpr (Coder::kDecodes) {
        if (!coder.ok())
          return false;
      }
    }
    return true;
  }

  /// The order with the smallest residuals.
  static int32_t best_order(const Vector<int32_t>& values) {
    int32_t best = 0;
    double least = 0;
    for (int32_t order = 0; order <= 2; ++order) {
      double bits = 0;
      for (size_t f = 0; f < values.size(); ++f) {
        int64_t r = std::llabs(int64_t{values[f]} - extrapolated(values, f, order));
        bits += floor_log2(static_cast<uint32_t>(r < 1 << 30 ? r + 1 : 1 << 30));
      }
      if (order == 0 || bits < least) {
        least = bits;
        best = order;
      }
    }
    return best;
  }

 private:
  static int64_t extrapolated(const Vector<int32_t>& x, size_t f, int32_t order) {
    if (order == 0 || f == 0)
      return 0;
    if (order == 1 || f == 1)
      return x[f - 1];
    return 2 * int64_t{x[f - 1]} - x[f - 2];
  }

  UnsignedModel order_;
  SymbolModel<> residual_[13];
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_SERIES_CODING_H_
