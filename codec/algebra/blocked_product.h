// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_BLOCKED_PRODUCT_H_
#define ANICODEC_CODEC_ALGEBRA_BLOCKED_PRODUCT_H_

#include <Eigen/Core>

namespace anicodec {

/// A matrix, or some columns of one.
using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

/// Depth of one product, in rows of a panel. Eigen splits a deeper one by the size of the first
/// cache, which would make the sums depend on the machine.
inline constexpr Eigen::Index kProductDepth = 240;

/// Rows a panel of this many columns should have: a multiple of kProductDepth that keeps the panel
/// at a few megabytes. Depends on nothing else, so neither do the sums.
Eigen::Index panel_depth(Eigen::Index columns);

/// sums += a^T b for panels of equally many rows. Parallel over tiles of the result; every entry is
/// summed in the order of the rows, so the result has the same bits for any number of threads.
void add_products(const MatrixView& a, const MatrixView& b, Eigen::MatrixXd& sums);

/// The same for b = a, upper triangle only; mirror_upper() completes it after the last panel.
void add_self_products(const MatrixView& a, Eigen::MatrixXd& sums);
void mirror_upper(Eigen::MatrixXd& sums);

/// a b and a^T b. Parallel; every entry is summed in order, kProductDepth numbers at a time, so the
/// result has the same bits for any number of threads.
Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b);
Eigen::MatrixXd inner_products(const MatrixView& a, const MatrixView& b);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_BLOCKED_PRODUCT_H_
