// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_POSE_MODELS_H_
#define ANICODEC_SDK_POSE_POSE_MODELS_H_

#include "format/coding/binary_coder.h"
#include "format/coding/magnitude_class.h"
#include "format/coding/mixing.h"
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

/// Models of the coordinates of a pose: how far each is from what is expected of it, in mixed
/// contexts of how well it is expected (spec/09b-reference-pose.md, section 5).
class PoseModels {
 public:
  PoseModels() : distance_({128, 64, 192, 640, 480}, {16, 6 * PosePrediction::kKinds}) {}

  /// Codes a coordinate. @pre |value| <= 2^22
  template <class Coder>
  int32_t code(Coder& coder, uint32_t kind, bool follows, int step,
               const PosePrediction::Expectation& e, int32_t value) {
    // Not a number is 0.
    const double mean = e.mean > -kFarthest ? std::min(e.mean, kFarthest)
                        : e.mean <= 0       ? -kFarthest
                                            : 0;
    const double whole = std::floor(mean + 0.5);
    const auto centre = static_cast<int32_t>(whole);
    const double fraction = mean - whole;  // within +-1/2
    const uint32_t last = step == 2,
                   role = static_cast<uint32_t>(step) * PosePrediction::kKinds + kind;
    const uint32_t scale = eighths(e.scale), half_octaves = magnitude_class<1>(scale, 32);
    distance_.select({magnitude_class<2>(scale, 64) * 2 + last,
                      magnitude_class<1>(eighths(e.near), 32) * 2 + last,
                      magnitude_class<1>(eighths(e.spread), 32) * 6 + last * 3 + kind / 2,
                      half_octaves * 20 + magnitude_class<0>(eighths(e.before), 10) * 2 + last,
                      half_octaves * (3 * PosePrediction::kKinds) + role},
                     magnitude_class<0>(scale, 16),
                     role + (follows ? 3 * PosePrediction::kKinds : 0));
    AdaptiveBit& sign = sign_[last][fraction < -0.25  ? 0
                                    : fraction < 0    ? 1
                                    : fraction < 0.25 ? 2
                                                      : 3];
    return centre + distance_.code(coder, value - centre,
                                   [&](bool negative) { return coder.bit(sign, negative); });
  }

 private:
  static constexpr double kFarthest = 1 << 22;

  /// In eighths of a step, rounded down; not a number is 0.
  static uint32_t eighths(double x) {
    const double scaled = 8 * x;
    return scaled > 0 ? scaled < 0x1p30 ? static_cast<uint32_t>(scaled) : 1U << 30 : 0;
  }

  MixedSymbolModel<5> distance_;
  AdaptiveBit sign_[2][4];
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_MODELS_H_
