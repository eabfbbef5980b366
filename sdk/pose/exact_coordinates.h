// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_EXACT_COORDINATES_H_
#define ANICODEC_SDK_POSE_EXACT_COORDINATES_H_

#include "format/coding/binary_coder.h"
#include "format/memory.h"
#include "sdk/pose/pose_prediction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Coordinates that are exactly those of a parallelogram, a neighbour or the vertex before, as in
/// shapes built along the axes (spec/09b-reference-pose.md, section 5).
class ExactCoordinates {
 public:
  explicit ExactCoordinates(uint32_t vertices) : hits_(vertices, {false, false, false}) {}

  /// Codes whether the coordinate *x of v is one of the candidates, and which; false if it is none.
  /// `mean`: what is expected of it, for a vertex without known neighbours that of the one before.
  template <class Coder>
  bool code(Coder& coder, const PosePrediction& prediction, double mean, const int32_t* positions,
            uint32_t v, size_t axis, int32_t* x) {
    const auto& neighbours = prediction.neighbours();
    uint32_t near = kMostNeighbours + 1;  // of the neighbours that are candidates, how many hit
    if (!neighbours.empty()) {
      near = 0;
      for (size_t i = 0; i < std::min(neighbours.size(), kMostNeighbours); ++i)
        near += hits_[neighbours[i]][axis];
    }
    count_ = 0;
    bool hit = false;
    const auto offer = [&](size_t slot, double candidate) {
      // Beyond any coordinate, or not a number.
      if (hit || !(candidate > -kLimit && candidate < kLimit))
        return;
      const auto value = static_cast<int32_t>(candidate);
      for (size_t i = 0; i < count_; ++i) {
        if (offered_[i] == value)
          return;
      }
      offered_[count_++] = value;
      const uint32_t kind = std::min<uint32_t>(prediction.kind(), 3);
      hit = coder.bit(model_[slot][axis][near][kind][last_], *x == value);
      if (hit)
        *x = value;
    };
    if (prediction.follows())
      offer(kSlots - 1, std::floor(prediction.likely()[axis] + 0.5));
    for (size_t g = 0; g < std::min(prediction.gates().size(), kMostGates); ++g)
      offer(g, prediction.gates()[g][axis]);
    for (size_t i = 0; i < std::min(neighbours.size(), kMostNeighbours); ++i)
      offer(kMostGates + i, positions[size_t{3} * neighbours[i] + axis]);
    if (neighbours.empty())
      offer(kMostGates + kMostNeighbours, std::floor(mean + 0.5));
    hits_[v][axis] = last_ = hit;
    return hit;
  }

 private:
  static constexpr size_t kMostGates = 2, kMostNeighbours = 3;
  static constexpr size_t kSlots = kMostGates + kMostNeighbours + 2;
  static constexpr double kLimit = 0x1p31;

  Vector<std::array<bool, 3>> hits_;
  AdaptiveBit model_[kSlots][3][kMostNeighbours + 2][4][2];
  std::array<int32_t, kSlots> offered_{};
  size_t count_ = 0;
  bool last_ = false;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_EXACT_COORDINATES_H_
