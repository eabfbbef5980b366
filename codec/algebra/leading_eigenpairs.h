// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_LEADING_EIGENPAIRS_H_
#define ANICODEC_CODEC_ALGEBRA_LEADING_EIGENPAIRS_H_

#include <functional>

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

/// The same for a matrix that is known by its products: times_matrix(columns) is the matrix times some
/// columns. All pairs of the space once the `count` largest are found as well as above, or the space has
/// `most` columns, some more for whole blocks: beyond them, a rough guess of what is left. Values are above
/// 1e-14 of the largest. Memory: up to four times rows x `most` doubles. Cost: a product with 16 columns for
/// every 16 of the space. @pre rows >= 16
Eigenpairs leading_eigenspace(
    const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& times_matrix, Eigen::Index rows,
    Eigen::Index count, Eigen::Index most);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_LEADING_EIGENPAIRS_H_
