// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Integers coded with a mixture of predictions, each with its own scale
// (spec/09c-reference-pose.md, section 6). Blending by past performance after B. Meyer and P.
// Tischer, "TMW - a new method for lossless image compression", 1997; the share given back after M.
// Herbster and M. Warmuth, "Tracking the best expert", 1998.
#ifndef ANICODEC_FORMAT_STUDENT_MIXTURE_H_
#define ANICODEC_FORMAT_STUDENT_MIXTURE_H_

#include "format/binary_coder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace anicodec {

/// What several predictors say of an integer: Student distributions with four degrees of freedom.
struct StudentMixture {
  static constexpr int kMost = 12;
  static constexpr double kLeastScale = 0.04, kRange = 1e10;

  int count = 0;
  double mean[kMost], scale[kMost], inverse[kMost];  ///< inverse: 1 / scale

  void clear() { count = 0; }

  /// Means beyond +-kRange, scales out of [kLeastScale, kRange] and what is not a number are
  /// replaced.
  void add(double m, double s) {
    mean[count] = m > -kRange && m < kRange ? m : 0;
    scale[count] = s > kLeastScale ? (s < kRange ? s : kRange) : kLeastScale;
    inverse[count] = 1 / scale[count];
    ++count;
  }

  /// Distribution function of one of them: 1/2 + u (3 - u^2) / 4 with u = z / sqrt(4 + z^2), z = x
  /// - mean in scales. Only operations that IEEE 754 rounds correctly.
  double below(int i, double x) const {
    const double z = (x - mean[i]) * inverse[i];
    const double u = z / std::sqrt(4 + z * z);
    return 0.5 + u * (0.75 - 0.25 * (u * u));
  }
};

/// Weights of the predictors, which follow how well they did. Codes any int32.
///
/// A decoder repeats it exactly: IEEE binary64, round to nearest, sums in ascending order.
class MixtureWeights {
 public:
  MixtureWeights() {
    for (double& w : weight_)
      w = 1;
  }

  /// Codes value: is it at least the rounded mean; then intervals away from there, each twice as
  /// wide as the one before; then bisection. At most 100 decisions.
  template <class Coder>
  int32_t code(Coder& coder, const StudentMixture& m, int32_t value) {
    double total = 0, mean = 0, scale = 0;
    for (int i = 0; i < m.count; ++i) {
      total += weight_[i];
      mean += weight_[i] * m.mean[i];
      scale += weight_[i] * m.scale[i];
    }
    const int64_t centre =
        std::min(std::max(limited(std::floor(mean / total + 0.5)), kLowest + 1), kHighest);
    const int64_t step = limited(scale / total) / 2 + 1;
    // Of the interval [low, high): the distribution function at its ends, in units of total.
    int64_t low = kLowest, high = kHighest + 1;
    double below_low = 0, below_high = total;
    const auto decide = [&](int64_t at) {  // is the value at least `at`, low < at < high?
      const double below = distribution(m, static_cast<double>(at) - 0.5);
      const double p = (below_high - below) / (below_high - below_low);
      const bool upper = coder.bit(probability(p), value >= at);
      (upper ? low : high) = at;
      (upper ? below_low : below_high) = below;
      return upper;
    };
    if (decide(centre)) {
      for (int64_t width = step; high > kHighest && low + width < high; width *= 2) {
        if (!decide(low + width))
          break;
      }
    } else {
      for (int64_t width = step; low == kLowest && high - width > low; width *= 2) {
        if (decide(high - width))
          break;
      }
    }
    while (high - low > 1)
      decide(low + (high - low) / 2);
    const auto coded = static_cast<int32_t>(low);
    if constexpr (Coder::kAdapts)
      learn(m, coded);
    return coded;
  }

 private:
  static constexpr int64_t kLowest = INT32_MIN, kHighest = INT32_MAX;
  static constexpr double kShare = 0.02, kLeast = 1e-9;

  /// As an integer within +-2^32; 0 for what is not a number.
  static int64_t limited(double x) {
    return x > -0x1p32 && x < 0x1p32 ? static_cast<int64_t>(x) : 0;
  }

  static uint32_t probability(double p) {
    constexpr double kLow = kMinProbability, kHigh = kProbabilityOne - kMinProbability;
    const double scaled = p * kProbabilityOne;
    if (scaled > kLow && scaled < kHigh)
      return static_cast<uint32_t>(scaled);
    return scaled <= kLow    ? kMinProbability
           : scaled >= kHigh ? kProbabilityOne - kMinProbability
                             : kProbabilityOne / 2;
  }

  double distribution(const StudentMixture& m, double x) const {
    double sum = 0;
    for (int i = 0; i < m.count; ++i)
      sum += weight_[i] * m.below(i, x);
    return sum;
  }

  void learn(const StudentMixture& m, int32_t value) {
    double likelihood[StudentMixture::kMost], sum = 0;
    for (int i = 0; i < m.count; ++i) {
      const double p = m.below(i, value + 0.5) - m.below(i, value - 0.5);
      likelihood[i] = weight_[i] * (p > kLeast ? p : kLeast);
      sum += likelihood[i];
    }
    for (int i = 0; i < m.count; ++i)
      weight_[i] = (1 - kShare) * (likelihood[i] / sum) + kShare / m.count;
  }

  double weight_[StudentMixture::kMost];
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_STUDENT_MIXTURE_H_
