// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Model of the coordinates of a pose: how far each is from what is expected of it, in contexts of
// how well it is expected (spec/09b-reference-pose.md, section 5).
#ifndef ANICODEC_SDK_POSE_POSE_MODEL_H_
#define ANICODEC_SDK_POSE_POSE_MODEL_H_

#include "format/coding/binary_coder.h"
#include "format/coding/magnitude_class.h"
#include "format/coding/symbol_row.h"
#include "sdk/pose/pose_prediction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace anicodec {

/// The expectation of (coordinate - parity) / 2.
inline PosePrediction::Expectation halved(const PosePrediction::Expectation& e, int32_t parity) {
  return {0.5 * (e.mean - parity), 0.5 * e.scale, 0.5 * e.near, 0.5 * e.spread, 0.5 * e.before};
}

/// The integer nearest to what is expected of a coordinate, and the quarter around it that this is in.
struct ExpectedInteger {
  explicit ExpectedInteger(double expected) {
    // Not a number is 0.
    const double mean = expected > -kFarthest ? std::min(expected, kFarthest)
                        : expected <= 0       ? -kFarthest
                                              : 0;
    const double whole = std::floor(mean + 0.5), fraction = mean - whole;  // within +-1/2
    centre = static_cast<int32_t>(whole);
    quarter = fraction < -0.25 ? 0 : fraction < 0 ? 1 : fraction < 0.25 ? 2 : 3;
  }

  int32_t centre;
  uint32_t quarter;

 private:
  static constexpr double kFarthest = 1 << 22;
};

/// A magnitude in eighths of a step, rounded down; not a number is 0.
inline uint32_t eighths(double x) {
  const double scaled = 8 * x;
  return scaled > 0 ? scaled < 0x1p30 ? static_cast<uint32_t>(scaled) : 1U << 30 : 0;
}

/// Codes coordinates by three rows of symbols, for RansEncoder and RansDecoder. Memory: 20 kB.
class PoseModel {
 public:
  /// Codes a coordinate. @pre |value| <= 2^22
  template <class Coder>
  int32_t code(Coder& coder, int step, const PosePrediction::Expectation& e, int32_t value) {
    const ExpectedInteger expected(e.mean);
    const uint32_t last = step == 2, scale = eighths(e.scale);
    // The lowest bits of what is expected to be large are as good as random.
    const int low = std::clamp(floor_log2(scale) - 4, 0, kMostLow);
    const auto class_of = [&](uint32_t x) { return magnitude_class<0>(x >> low, kNear); };
    const uint32_t size = magnitude_class<2>(scale, kScales), before = class_of(eighths(e.before)),
                   spread = class_of(eighths(e.spread));
    const int32_t distance = value - expected.centre;
    const auto symbol = [&](uint32_t s) {
      return code_row_symbol(coder, scale_[size][last],
                             near_[before][class_of(eighths(e.near))][last],
                             spread_[spread][class_of(scale)][last], s);
    };
    const auto more = [&](uint32_t s) {
      return code_row_symbol(coder, scale_excess_[size], before_excess_[before],
                             spread_excess_[spread], s);
    };
    const auto magnitude = static_cast<int32_t>(
        code_row_magnitude(coder, symbol, more, far_, low,
                           static_cast<uint32_t>(distance < 0 ? -distance : distance)));
    if (magnitude == 0)
      return expected.centre;
    const bool negative = coder.bit(sign_[last][expected.quarter], distance < 0);
    return expected.centre + (negative ? -magnitude : magnitude);
  }

 private:
  static constexpr uint32_t kScales = 64, kNear = 16;
  static constexpr int kMostLow = 12;

  SymbolRow scale_[kScales][2], near_[kNear][kNear][2], spread_[kNear][kNear][2];
  SymbolRow scale_excess_[kScales], before_excess_[kNear], spread_excess_[kNear];
  RowNumber far_;
  AdaptiveBit sign_[2][4];
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_MODEL_H_
