// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The last operations of a prediction, for one value or a vector of them. Internal to sdk/.
#ifndef ANICODEC_SDK_PREDICTION_PREDICTION_ROUNDING_H_
#define ANICODEC_SDK_PREDICTION_PREDICTION_ROUNDING_H_

namespace anicodec {

/// Predictions and coefficients are kept within this magnitude, in steps.
constexpr float kMaxCoefficient = 1048576.0f;

// Internal linkage: see prediction_kernel.h.
namespace {

/// A value that is not a number becomes the limit.
template <typename Float>
inline Float limited_coefficient(Float y) {
  const Float limit = Float{} + kMaxCoefficient;
  y = y < limit ? y : limit;
  return y > -limit ? y : -limit;
}

/// To 1/64 step, ties to even.
template <typename Float>
inline Float rounded_prediction(Float p) {
  constexpr float kMagic = 12582912.0f;  // 1.5 * 2^23: values near it are integers
  Float u = limited_coefficient(p) * 64.0f;
  u = u + kMagic;
  u = u - kMagic;
  return u * (1.0f / 64.0f);
}

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_PREDICTION_ROUNDING_H_
