// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/trajectory_gram.h"

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

TEST(TrajectoryGram, CombinesRows) {
  const size_t frames = 9, n = 500;
  const std::vector<float> x = affine_points(frames, n);
  const Vector3d origin(1, -2, 3);
  const FrameView view(x.data(), frames, n);
  const MatrixXd rows = trajectories(x, frames, origin);
  EXPECT_LT((trajectory_gram(view, origin) - rows * rows.transpose()).norm(),
            1e-12 * (rows * rows.transpose()).norm());
  const MatrixXd weights = MatrixXd::Random(static_cast<Index>(3 * frames), 4);
  MatrixXd combined(static_cast<Index>(n), 4);
  combine_rows(view, origin, weights, [&](size_t first, const MatrixXd& block) {
    combined.middleRows(static_cast<Index>(first), block.rows()) = block;
  });
  EXPECT_LT((combined - rows.transpose() * weights).norm(), 1e-10 * combined.norm());
  EXPECT_LT((project_on_functions(view, origin, combined) - rows * combined).norm(),
            1e-10 * (rows * combined).norm());
}

}  // namespace
}  // namespace anicodec
