// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_POSE_TURN_H_
#define ANICODEC_SDK_POSE_POSE_TURN_H_

#include "format/coding/recursive_least_squares.h"
#include "sdk/base/vector3.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// How one piece of a surface is turned against another one that it is like: a linear map, learnt
/// from vertex to vertex (spec/09b-reference-pose.md, section 7).
class PoseTurn {
 public:
  /// `flips`: bit d is set if axis d points the other way, about.
  explicit PoseTurn(uint32_t flips = 0) : flips_(flips) {
    std::array<double, 3> variance;
    variance.fill(kVariance);
    for (size_t d = 0; d < 3; ++d) {
      std::array<double, 3> row{};
      row[d] = flips >> d & 1 ? -1 : 1;
      rows_[d].start(3, row, variance);
    }
  }

  /// Whether right and left are exchanged.
  bool mirrors() const { return (flips_ ^ flips_ >> 1 ^ flips_ >> 2) & 1; }

  Vector3 apply(const Vector3& x) const {
    const std::array<double, 3> in{x[0], x[1], x[2]};
    return {{rows_[0].predict(in), rows_[1].predict(in), rows_[2].predict(in)}};
  }

  /// Learns that x became y.
  void learn(const Vector3& x, const Vector3& y) {
    const std::array<double, 3> in{x[0], x[1], x[2]};
    const double noise = 1 + kNoise * dot(x, x);
    for (size_t d = 0; d < 3; ++d)
      rows_[d].learn(in, y[d], noise);
  }

 private:
  static constexpr double kVariance = 0.1, kNoise = 1e-3;

  uint32_t flips_;
  RecursiveLeastSquares<3, 994> rows_[3];
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_TURN_H_
