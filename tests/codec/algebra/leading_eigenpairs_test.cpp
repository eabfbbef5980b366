// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/leading_eigenpairs.h"

#include "codec/segment/linear_basis.h"
#include "tests/codec/moving_points.h"

#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

TEST(LeadingEigenpairs, AgreeWithTheFullDecomposition) {
  for (const Index n : {20, 700}) {
    const Index rank = std::min<Index>(n, 240);
    const std::vector<float> values = noise_values(static_cast<size_t>(n * rank), 11);
    MatrixXd a(n, rank);
    for (Index j = 0; j < rank; ++j)
      for (Index i = 0; i < n; ++i)
        a(i, j) = static_cast<double>(values[static_cast<size_t>(j * n + i)]) *
                  std::exp(-0.1 * static_cast<double>(j));
    const MatrixXd symmetric = a * a.transpose();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> full(symmetric);
    const double smallest = full.eigenvalues()[n - 15];
    for (const Index count : {Index{5}, Index{1000}}) {
      const Eigenpairs pairs = leading_eigenpairs(symmetric, count, smallest);
      ASSERT_EQ(pairs.values.size(), std::min<Index>(count, 14));
      for (Index j = 0; j < pairs.values.size(); ++j) {
        EXPECT_NEAR(pairs.values[j], full.eigenvalues()[n - 1 - j], 1e-3 * pairs.values[j]);
        EXPECT_LT(
            (symmetric * pairs.vectors.col(j) - pairs.values[j] * pairs.vectors.col(j)).norm(),
            0.03 * pairs.values[j]);
      }
      EXPECT_LT((pairs.vectors.transpose() * pairs.vectors -
                 MatrixXd::Identity(pairs.values.size(), pairs.values.size()))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-10);
    }
  }
}

TEST(LeadingEigenpairs, FindAllOfASpectrumThatDoesNotDecay) {
  const MatrixXd identity = MatrixXd::Identity(400, 400);
  EXPECT_EQ(leading_eigenpairs(identity, 1000, 0.5).values.size(), 400);
  EXPECT_EQ(leading_eigenpairs(MatrixXd::Zero(400, 400), 1000, 0).values.size(), 0);
}

}  // namespace
}  // namespace anicodec
