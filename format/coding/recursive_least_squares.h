// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_CODING_RECURSIVE_LEAST_SQUARES_H_
#define ANICODEC_FORMAT_CODING_RECURSIVE_LEAST_SQUARES_H_

#include <array>
#include <cstddef>

namespace anicodec {

/// Linear prediction whose weights follow the data by recursive least squares with forgetting (S.
/// Haykin, "Adaptive Filter Theory", chapter 10).
///
/// A decoder repeats it exactly: IEEE binary64, round to nearest, no contraction, every sum in
/// ascending order, nothing but + - * /. Sizes up to kSize regressors; what was learnt n values ago
/// counts (kForgetPerMille / 1000)^n.
template <size_t kSize, int kForgetPerMille = 999>
class RecursiveLeastSquares {
 public:
  using Vector = std::array<double, kSize>;

  /// Starts over with these weights; `variance` holds the diagonal of the weights' covariance.
  void start(size_t size, const Vector& weights, const Vector& variance) {
    size_ = size;
    w_ = weights;
    start_ = variance;
    reset_covariance();
  }

  size_t size() const { return size_; }

  double predict(const Vector& z) const {
    double sum = 0;
    for (size_t i = 0; i < size_; ++i)
      sum += w_[i] * z[i];
    return sum;
  }

  /// Learns that z went with `value`, whose noise has this variance. One division.
  void learn(const Vector& z, double value, double noise) {
    const double error = value - predict(z);
    // The matrix is symmetric: row j holds what regressor j adds to the gains.
    Row gain{};
    for (size_t j = 0; j < size_; ++j) {
#pragma GCC unroll 16  // gains stay in registers
      for (size_t i = 0; i < kRow; ++i)
        gain[i] += p_[j][i] * z[j];
    }
    double denominator = kForget * noise;
    for (size_t i = 0; i < size_; ++i)
      denominator += z[i] * gain[i];
    const double scale = 1 / denominator;
    for (size_t i = 0; i < size_; ++i)
      w_[i] += gain[i] * scale * error;
    double trace = 0;
    for (size_t i = 0; i < size_; ++i) {
      for (size_t j = 0; j < kRow; ++j)
        p_[i][j] = (p_[i][j] - gain[i] * gain[j] * scale) * kRemember;
      trace += p_[i][i];
    }
    if (!(trace < 1e12))
      reset_covariance();
  }

 private:
  static constexpr double kForget = kForgetPerMille / 1000.0, kRemember = 1 / kForget;
  static constexpr size_t kRow = (kSize + 1) / 2 * 2;  ///< whole registers of two
  using Row = std::array<double, kRow>;

  void reset_covariance() {
    p_ = {};
    for (size_t i = 0; i < size_; ++i)
      p_[i][i] = start_[i];
  }

  size_t size_ = 0;
  Vector w_{}, start_{};
  std::array<Row, kSize> p_{};  ///< zeros from size_ on
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_RECURSIVE_LEAST_SQUARES_H_
