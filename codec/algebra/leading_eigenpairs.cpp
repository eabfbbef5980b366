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
  if (symmetric.rows() == 0)
    return {VectorXd(), MatrixXd(0, 0)};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return select(solver.eigenvalues(), solver.eigenvectors(), max_count, smallest);
}

// An orthonormal basis of the columns of w, orthogonal to the columns of q.
MatrixXd orthonormal(MatrixXd w, const MatrixView& q) {
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough
    w -= product(q, inner_products(q, w));
    const Eigen::HouseholderQR<MatrixXd> qr(w);
    w = qr.householderQ() * MatrixXd::Identity(w.rows(), w.cols());
  }
  return w;
}

/// A block Krylov space as it grows.
class Krylov {
 public:
  explicit Krylov(Index rows) : next_(rows, kWidth), space_(rows, 0), image_(rows, 0) {
    LinearCongruence random(1);
    for (double& x : next_.reshaped())
      x = random.symmetric();
    next_ = orthonormal(std::move(next_), space());
  }

  Index size() const { return size_; }

  /// kWidth columns more.
  template <class Matrix>
  void grow(const Matrix& times_matrix) {
    if (size_ > 0)
      next_ = orthonormal(image_.middleCols(size_ - kWidth, kWidth), space());
    if (size_ + kWidth > space_.cols()) {
      const Index room = std::max(4 * kWidth, 2 * size_);
      space_.conservativeResize(Eigen::NoChange, room);
      image_.conservativeResize(Eigen::NoChange, room);
    }
    space_.middleCols(size_, kWidth) = next_;
    image_.middleCols(size_, kWidth) = times_matrix(next_);
    size_ += kWidth;
  }

  /// Pairs of the matrix within the space, their vectors by its columns.
  Eigenpairs pairs(Index max_count, double smallest) const {
    return diagonalise(inner_products(space(), image()), max_count, smallest);
  }

  MatrixXd vectors(const Eigenpairs& of_space) const { return product(space(), of_space.vectors); }

  /// Whether these pairs, vectors in full, are those of the matrix.
  bool converged(const Eigenpairs& of_space, const MatrixXd& vectors) const {
    const MatrixXd residual =
        product(image(), of_space.vectors) - vectors * of_space.values.asDiagonal();
    for (Index j = 0; j < of_space.values.size(); ++j) {
      if (residual.col(j).norm() >
          std::max(kResidual * of_space.values[j], kNoise * of_space.values[0]))
        return false;
    }
    return true;
  }

  /// The size at which to look next whether pairs have converged.
  Index next_check() const { return size_ + std::max(2 * kWidth, size_ / 3 / kWidth * kWidth); }

 private:
  MatrixView space() const { return space_.leftCols(size_); }

  MatrixView image() const { return image_.leftCols(size_); }

  MatrixXd next_, space_, image_;
  Index size_ = 0;
};

constexpr Index kFirstCheck = 4 * kWidth;

}  // namespace

Eigenpairs leading_eigenpairs(const MatrixXd& symmetric, Index max_count, double smallest,
                              Index direct_size) {
  const Index n = symmetric.rows();
  if (n <= direct_size)
    return diagonalise(symmetric, max_count, smallest);
  const Index limit = n / 2 / kWidth * kWidth;
  Krylov krylov(n);
  Index check = kFirstCheck;
  while (krylov.size() < limit) {
    krylov.grow([&](const MatrixXd& columns) { return product(symmetric, columns); });
    const Index size = krylov.size();
    if (size < check && size < limit)
      continue;
    const Eigenpairs small = krylov.pairs(max_count, smallest);
    const Index count = small.values.size();
    // All of the space above the threshold: there may be more of them.
    if (count < size) {
      MatrixXd vectors = krylov.vectors(small);
      // A value below the threshold that has not converged may still rise above it.
      if (krylov.converged(small, vectors) && (count == max_count || size >= count + 2 * kWidth))
        return {small.values, std::move(vectors)};
    }
    check = krylov.next_check();
  }
  return diagonalise(symmetric, max_count, smallest);
}

Eigenpairs leading_eigenspace(const std::function<MatrixXd(const MatrixXd&)>& times_matrix,
                              Index rows, Index count, Index most) {
  constexpr double kSmallest = 1e-14;  // of the largest value: below is rounding
  const Index limit = std::min((most + kWidth - 1) / kWidth * kWidth, rows);
  Krylov krylov(rows);
  Index check = kFirstCheck;
  for (;;) {
    krylov.grow(times_matrix);
    const Index size = krylov.size();
    if (size < std::max(check, count) && size + kWidth <= limit)
      continue;
    const Eigenpairs wanted = krylov.pairs(count, 0);
    if (size + kWidth > limit || wanted.values.size() < count ||
        krylov.converged(wanted, krylov.vectors(wanted))) {
      const double largest = wanted.values.size() > 0 ? wanted.values[0] : 0;
      const Eigenpairs all = krylov.pairs(size, kSmallest * largest);
      return {all.values, krylov.vectors(all)};
    }
    check = krylov.next_check();
  }
}

}  // namespace anicodec
