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
// Rows from which threads share a product. The sums of smaller ones are Eigen's: files of dance, chicken and flag differ
// by up to half a per cent, to either side, with sums in another order.
constexpr Index kShared = 2000;
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
MatrixXd orthonormal(MatrixXd w, const Eigen::Ref<const MatrixXd>& q) {
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough
    w -= q * (q.transpose() * w).eval();
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
    if (n < kShared) {
      image.middleCols(size, kWidth).noalias() = symmetric * next;
    } else {
      MatrixXd products = MatrixXd::Zero(n, kWidth);
      add_products(symmetric, next, products);
      image.middleCols(size, kWidth) = products;
    }
    size += kWidth;
    if (size >= check || size == limit) {
      const MatrixXd projected = space.leftCols(size).transpose() * image.leftCols(size);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(projected);
      const Eigenpairs small =
          select(solver.eigenvalues(), solver.eigenvectors(), max_count, smallest);
      const Index count = small.values.size();
      // All of the space above the threshold: there may be more of them.
      if (count < size) {
        const MatrixXd vectors = space.leftCols(size) * small.vectors;
        const MatrixXd residual =
            image.leftCols(size) * small.vectors - vectors * small.values.asDiagonal();
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
