// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_BASE_BOUNDED_FLOAT_H_
#define ANICODEC_SDK_BASE_BOUNDED_FLOAT_H_

#include <cmath>

namespace anicodec {

/// Largest magnitude of the weights, matrix entries, origins and corrections that a player uses
/// (spec/09a-segments.md, section 7). With coefficients below 2^31 and at most 2^20 components all
/// sums are finite.
inline constexpr double kLargestFactor = 0x1p64;

/// Converts; false, and nothing is stored, if x is too large or not a number.
inline bool to_float(double x, float* out) {
  if (!(std::fabs(x) <= kLargestFactor))
    return false;
  *out = static_cast<float>(x);
  return true;
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_BOUNDED_FLOAT_H_
