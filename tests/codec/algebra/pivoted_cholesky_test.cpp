// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/pivoted_cholesky.h"

#include "tests/codec/moving_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(PivotedCholesky, SolvesDefiniteSystems) {
  const MatrixXd half = random_matrix(20, 12, 1);
  const MatrixXd matrix = half.transpose() * half;
  const MatrixXd x = random_matrix(12, 3, 2);
  const PivotedCholesky factor(matrix, 1e-12, 12);
  EXPECT_EQ(factor.rank(), 12u);
  EXPECT_LT((factor.solve(matrix * x) - x).norm(), 1e-9);
}

TEST(PivotedCholesky, RevealsTheRankAndSolvesConsistentSystems) {
  const MatrixXd half = random_matrix(4, 15, 3);
  const MatrixXd matrix = half.transpose() * half;
  const PivotedCholesky factor(matrix, 1e-12 * matrix.trace(), 15);
  EXPECT_EQ(factor.rank(), 4u);
  const VectorXd right = matrix * random_matrix(15, 1, 4);
  EXPECT_LT((matrix * factor.solve(right) - right).norm(), 1e-9);
}

TEST(PivotedCholesky, TakesTheLargestRemainingFirstAndTheLowestOfEquals) {
  const VectorXd diagonal{{2, 7, 7, 1}};
  const PivotedCholesky factor(diagonal.asDiagonal(), 1.5, 4);
  EXPECT_THAT(factor.pivots(), testing::ElementsAre(1, 2, 0));
  EXPECT_THAT(PivotedCholesky(diagonal.asDiagonal(), 0, 1).pivots(), testing::ElementsAre(1));
}

TEST(PivotedCholesky, FindsNothingInAZeroMatrix) {
  const PivotedCholesky factor(MatrixXd::Zero(3, 3), 0, 3);
  EXPECT_EQ(factor.rank(), 0u);
  EXPECT_EQ(factor.solve(MatrixXd::Ones(3, 2)), MatrixXd::Zero(3, 2));
}

}  // namespace
}  // namespace anicodec
