// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/pivoted_cholesky.h"

#include <algorithm>
#include <cmath>

namespace anicodec {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

PivotedCholesky::PivotedCholesky(const MatrixXd& matrix, double tolerance, size_t max_rank)
    : size_(matrix.rows()) {
  const Index limit = std::min(size_, static_cast<Index>(max_rank));
  VectorXd remaining = matrix.diagonal();
  MatrixXd columns(size_, limit);
  Index k = 0;
  for (; k < limit; k++) {
    Index pivot = 0;
    const double largest = remaining.maxCoeff(&pivot);
    if (!(largest > tolerance)) {
      break;
    }
    VectorXd column = matrix.col(pivot);
    column.noalias() -= columns.leftCols(k) * columns.row(pivot).head(k).transpose();
    column /= std::sqrt(largest);
    for (uint32_t earlier : pivots_) {
      column[earlier] = 0;
    }
    column[pivot] = std::sqrt(largest);
    columns.col(k) = column;
    remaining -= column.cwiseAbs2();
    pivots_.push_back(static_cast<uint32_t>(pivot));
    for (uint32_t taken : pivots_) {
      remaining[taken] = -1;
    }
  }
  factor_.resize(k, k);
  for (Index i = 0; i < k; i++) {
    factor_.row(i) = columns.row(pivots_[static_cast<size_t>(i)]).head(k);
  }
}

MatrixXd PivotedCholesky::solve(const MatrixXd& right) const {
  MatrixXd part(factor_.rows(), right.cols());
  for (size_t i = 0; i < pivots_.size(); i++) {
    part.row(static_cast<Index>(i)) = right.row(pivots_[i]);
  }
  const auto lower = factor_.triangularView<Eigen::Lower>();
  lower.solveInPlace(part);
  lower.transpose().solveInPlace(part);
  MatrixXd solution = MatrixXd::Zero(size_, right.cols());
  for (size_t i = 0; i < pivots_.size(); i++) {
    solution.row(pivots_[i]) = part.row(static_cast<Index>(i));
  }
  return solution;
}

}  // namespace anicodec
