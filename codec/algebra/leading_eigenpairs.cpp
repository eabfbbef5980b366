// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/leading_eigenpairs.h"

#include "codec/algebra/blocked_product.h"
#include "codec/sequence/random.h"

#include <algorithm>
#include <cstdint>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kWidth = 16;
constexpr double kResidual = 0.02, kNoise = 1e-12;  // of a value, and of the largest one

// Descending; only as many as are wanted.
Eigenpairs select(const VectorXd& ascending, const MatrixXd& vectors, Index max_count,
                  double smallest) {
  Index count = 0;
  const Index n = ascending.size();
  while (count < std::min(max_count, n) && ascending[n - 1 - count] > smallest)
    ++count;
  return {ascending.tail(count).reverse(), vectors.rightCols(count).rowwise().reverse()};
}

Eigenpairs diagonalise(const MatrixXd& symmetric, Index max_count, double smallest) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return select(solver.eigenvalues(), solver.eigenvectors(), max_count, smallest);
}

// Orthonormal columns that span those of w without what q spans.
MatrixXd orthonormal(MatrixXd w, const MatrixView& q) {
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough
    w -= product(q, inner_products(q, w));
    const Eigen::HouseholderQR<MatrixXd> qr(w);
    w = qr.householderQ() * MatrixXd::Identity(w.rows(), w.cols());
  }
  return w;
}

}  // namespace

Eigenpairs leading_eigenpairs(const MatrixXd& symmetric, Index max_count, double smallest,
                              Index direct_size) {
  const Index n = symmetric.rows();
  if (n <= direct_size)
    return diagonalise(symmetric, max_count, smallest);
  const Index limit = n / 2 / kWidth * kWidth;
  MatrixXd space(n, limit), image(n, limit);
  MatrixXd start(n, kWidth);
  LinearCongruence random(1);
  for (double& x : start.reshaped())
    x = random.symmetric();
  MatrixXd next = orthonormal(start, space.leftCols(0));
  Index size = 0, check = 4 * kWidth;
  while (size < limit) {
    space.middleCols(size, kWidth) = next;
    image.middleCols(size, kWidth) = product(symmetric, next);
    size += kWidth;
    if (size >= check || size == limit) {
      const MatrixXd projected = inner_products(space.leftCols(size), image.leftCols(size));
      const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(projected);
      const Eigenpairs small =
          select(solver.eigenvalues(), solver.eigenvectors(), max_count, smallest);
      const Index count = small.values.size();
      // All of the space above the threshold: there may be more of them.
      if (count < size) {
        const MatrixXd vectors = product(space.leftCols(size), small.vectors);
        const MatrixXd residual = product(image.leftCols(size), small.vectors) -
                                  vectors * small.values.asDiagonal();
        bool converged = true;
        for (Index j = 0; j < count && converged; ++j)
          converged = residual.col(j).norm() <=
                      std::max(kResidual * small.values[j], kNoise * small.values[0]);
        // A value below the threshold that has not converged may still rise above it.
        if (converged && (count == max_count || size >= count + 2 * kWidth)) {
          return {small.values, vectors};
        }
      }
      check = size + std::max(2 * kWidth, size / 3 / kWidth * kWidth);
    }
    next = orthonormal(image.middleCols(size - kWidth, kWidth), space.leftCols(size));
  }
  return diagonalise(symmetric, max_count, smallest);
}

}  // namespace anicodec
