// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_PIVOTED_CHOLESKY_H_
#define ANICODEC_CODEC_ALGEBRA_PIVOTED_CHOLESKY_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Rank-revealing Cholesky factorisation of a symmetric positive semidefinite matrix: the row with
/// the largest remaining diagonal is eliminated next (the lowest index among equals) until max_rank
/// rows are taken or no remaining diagonal exceeds the tolerance. On a Gram matrix this is QR with
/// column pivoting of the vectors behind it. Cost O(n rank^2).
class PivotedCholesky {
 public:
  PivotedCholesky(const Eigen::MatrixXd& matrix, double tolerance, size_t max_rank);

  size_t rank() const { return pivots_.size(); }

  /// Rows in the order of elimination.
  const std::vector<uint32_t>& pivots() const { return pivots_; }

  /// Solves for the pivots' unknowns and leaves the others zero. One column per right-hand side.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  Eigen::Index size_;
  std::vector<uint32_t> pivots_;
  Eigen::MatrixXd factor_;  // rank x rank, lower triangle, in pivot order
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_PIVOTED_CHOLESKY_H_
