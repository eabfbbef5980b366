// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_DEPENDENT_STEPS_H_
#define ANICODEC_SDK_POSE_DEPENDENT_STEPS_H_

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Dependent quantisation of a series of integers (spec/09b-reference-pose.md): which
/// integers an entry may be, the even or the odd ones, follows from those before it by a trellis of
/// eight states, so that a code has half of the integers to tell apart. After M. Marcellin and T.
/// Fischer, "Trellis coded quantization of memoryless and Gauss-Markov sources", 1990.
class DependentSteps {
 public:
  static constexpr size_t kStates = 8;

  /// 0 where entries are even, 1 where they are odd.
  static constexpr int32_t parity(size_t state) { return static_cast<int32_t>(state & 1); }

  /// The state after an entry 2 * half + parity(state).
  static constexpr size_t next(size_t state, int32_t half) {
    constexpr uint8_t kNext[kStates][2] = {{0, 2}, {5, 7}, {1, 3}, {6, 4},
                                           {2, 0}, {4, 6}, {3, 1}, {7, 5}};
    return kNext[state][half & 1];
  }
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_DEPENDENT_STEPS_H_
