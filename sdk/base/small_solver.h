// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Small symmetric systems by Cholesky's method, in a fixed order of operations.
#ifndef ANICODEC_SDK_BASE_SMALL_SOLVER_H_
#define ANICODEC_SDK_BASE_SMALL_SOLVER_H_

#include <array>
#include <cmath>
#include <cstddef>

namespace anicodec {

/// A x = b for a symmetric positive definite A of up to kMost rows, of which the lower triangle is
/// read, and kRight columns b.
template <size_t kMost, size_t kRight = 1>
struct SmallSystem {
  double a[kMost][kMost] = {};
  double b[kMost][kRight] = {};

  /// Replaces b by x and a by its factor. False when A is not clearly positive definite.
  bool solve(size_t n) {
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j <= i; ++j) {
        double s = a[i][j];
        for (size_t k = 0; k < j; ++k)
          s -= a[i][k] * a[j][k];
        if (i == j && !(s > kLeastPivot))
          return false;
        a[i][j] = i == j ? std::sqrt(s) : s / a[j][j];
      }
    }
    for (size_t r = 0; r < kRight; ++r) {
      for (size_t i = 0; i < n; ++i) {
        double s = b[i][r];
        for (size_t k = 0; k < i; ++k)
          s -= a[i][k] * b[k][r];
        b[i][r] = s / a[i][i];
      }
      for (size_t i = n; i-- > 0;) {
        double s = b[i][r];
        for (size_t k = i + 1; k < n; ++k)
          s -= a[k][i] * b[k][r];
        b[i][r] = s / a[i][i];
      }
    }
    return true;
  }

 private:
  static constexpr double kLeastPivot = 1e-12;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_SMALL_SOLVER_H_
