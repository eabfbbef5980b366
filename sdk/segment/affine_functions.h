// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The functions 1, x, y, z of a reference pose as basis functions (spec/09-reconstruction.md).
#ifndef ANICODEC_SDK_SEGMENT_AFFINE_FUNCTIONS_H_
#define ANICODEC_SDK_SEGMENT_AFFINE_FUNCTIONS_H_

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Number of affine functions.
inline constexpr size_t kAffineFunctions = 4;

/// 1, x, y, z made orthonormal over the vertices of a pose (Gram-Schmidt, in this order). A weight
/// per function and axis then moves the whole mesh by an affine map. A function that depends on
/// those before it, as z does on a flat pose, is zero.
struct AffineFunctions {
  double constant = 0;        ///< value of the first function
  double mean[3] = {};        ///< of the pose, on its integer grid
  double inverse[3][3] = {};  ///< lower triangular: the others are inverse * (p - mean)

  /// For a pose of vertex_count x 3 integers, or for its vertices of one region, by a number for each;
  /// `regions` null: all. Cost: two passes. In double and in fixed order.
  static AffineFunctions of(const int32_t* pose, size_t vertex_count,
                            const uint8_t* regions = nullptr, uint32_t region = 0);

  /// Values of the functions at grid position p.
  void evaluate(const double p[3], double values[kAffineFunctions]) const;

  /// The affine map (3 x 4, row-major, translation last) from grid positions that has these
  /// weights: weights[axis][function].
  void map(const double weights[3][kAffineFunctions], double out[12]) const;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_AFFINE_FUNCTIONS_H_
