// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/normal_fit.h"

#include "codec/massage/denoise.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

TEST(NormalFit, BringsPolygonsToTheCurvedSurface) {
  const TestMesh ball = sphere(8);
  const Surface surface(ball.topology, ball.positions);
  Positions v = ball.positions;
  for (Index i = 0; i < v.rows(); ++i)
    v.row(i) *= 1 + 0.02 * std::sin(3.0 * static_cast<double>(i));
  fit_normals(surface, 2, &v);
  for (Index i = 0; i < v.rows(); ++i)
    EXPECT_NEAR(v.row(i).norm(), 1, 0.006) << i;
}

TEST(NormalFit, LeavesTheBoundary) {
  const TestMesh sheet = flat_sheet(6);
  const Surface surface(sheet.topology, sheet.positions);
  Positions v = sheet.positions;
  v(0, 2) = 0.1;
  v(14, 2) = 0.1;
  fit_normals(surface, 1, &v);
  EXPECT_EQ(v(0, 2), 0.1);
  EXPECT_LT(std::abs(v(14, 2)), 0.02);
}

}  // namespace
}  // namespace anicodec
