// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_SYMMETRIC_SOLVE_H_
#define ANICODEC_CODEC_ALGEBRA_SYMMETRIC_SOLVE_H_

#include <Eigen/Core>

namespace anicodec {

/// X with A X = B for a positive semidefinite A (n x n), by its LDL^T with pivots; where A is singular,
/// X is of no use. B: n x columns. Cost O(n^3 + n^2 columns).
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_SYMMETRIC_SOLVE_H_
