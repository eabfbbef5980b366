// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/blocked_product.h"

#include "tests/codec/moving_points.h"

#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// The product by one loop for each entry.
Eigen::MatrixXd plain_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.cols(); ++i) {
      for (Eigen::Index d = 0; d < a.rows(); d += kProductDepth) {
        double sum = 0;
        for (Eigen::Index k = d; k < std::min(d + kProductDepth, a.rows()); ++k)
          sum += a(k, i) * b(k, j);
        sums(i, j) += sum;
      }
    }
  }
  return sums;
}

// So registers of any width give the same bits.
TEST(BlockedProduct, HasTheBitsOfAPlainLoop) {
  for (const auto& [depth, rows, columns] :
       {std::tuple<Eigen::Index, Eigen::Index, Eigen::Index>{1, 1, 1},
        {7, 3, 5},
        {240, 64, 64},
        {500, 131, 67},
        {241, 16, 9}}) {
    const Eigen::MatrixXd a = random_matrix(depth, rows, 1), b = random_matrix(depth, columns, 2);
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(rows, columns);
    add_products(a, b, sums);
    EXPECT_EQ(sums, plain_product(a, b)) << depth << " " << rows << " " << columns;
    EXPECT_EQ(inner_products(a, b), sums);
    EXPECT_EQ(product(a.transpose(), b), sums);
    Eigen::MatrixXd self = Eigen::MatrixXd::Zero(rows, rows);
    add_self_products(a, self);
    mirror_upper(self);
    EXPECT_EQ(self, plain_product(a, a)) << depth << " " << rows;
  }
}

TEST(BlockedProduct, TakesColumnsOfALargerMatrix) {
  const Eigen::MatrixXd all = random_matrix(530, 90, 3);
  const Eigen::MatrixXd a = all.middleCols(5, 37), b = all.rightCols(20), c = all.topRows(37);
  EXPECT_EQ(inner_products(all.middleCols(5, 37), all.rightCols(20)), plain_product(a, b));
  EXPECT_EQ(product(all.middleCols(5, 37), c), plain_product(a.transpose(), c));
}

}  // namespace
}  // namespace anicodec
