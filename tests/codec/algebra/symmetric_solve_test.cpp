// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/symmetric_solve.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(SymmetricSolve, GivesBackWhatWasMultiplied) {
  const Eigen::MatrixXd half{{2, 0, 0}, {-1, 3, 0}, {0.5, 4, 1}}, x{{1, -2}, {0, 5}, {7, 0.25}};
  const Eigen::MatrixXd a = half * half.transpose();
  EXPECT_TRUE(solve_symmetric(a, Eigen::MatrixXd(a * x)).isApprox(x, 1e-12));
  const Eigen::VectorXd first = x.col(0);
  EXPECT_TRUE(solve_symmetric(a, Eigen::VectorXd(a * first)).isApprox(first, 1e-12));
}

}  // namespace
}  // namespace anicodec
