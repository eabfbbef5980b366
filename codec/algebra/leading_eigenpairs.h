// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_LEADING_EIGENPAIRS_H_
#define ANICODEC_CODEC_ALGEBRA_LEADING_EIGENPAIRS_H_

#include <Eigen/Core>

namespace anicodec {

/// Largest eigenvalues of a symmetric matrix, descending, with orthonormal eigenvectors in columns.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Eigenpairs with values above `smallest`, at most max_count. Matrices of at most direct_size rows
/// are diagonalised; of larger ones a block Krylov space is built that holds the wanted pairs (Golub
/// and Underwood 1977, with full reorthogonalisation), with residuals below 2 % of the value, which is
/// then right to some parts in ten thousand. Deterministic: the start vectors are fixed. Cost O(n^3),
/// or O(n^2 count) where few pairs are wanted.
Eigenpairs leading_eigenpairs(const Eigen::MatrixXd& symmetric, Eigen::Index max_count,
                              double smallest, Eigen::Index direct_size = 320);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_LEADING_EIGENPAIRS_H_
