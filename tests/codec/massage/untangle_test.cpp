// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/untangle.h"

#include "codec/massage/normal_fit.h"
#include "codec/surface/mesh_quality.h"
#include "codec/transfer/distance_fit.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

TEST(Untangle, TurnsATriangleByALittleMove) {
  const TestMesh sheet = flat_sheet(8);
  const Surface surface(sheet.topology, sheet.positions);
  Positions v = sheet.positions;
  v.row(27) += Eigen::RowVector3d(1.1, 0.2, 0);  // over the far side of its ring
  ASSERT_FALSE(turned_in_place(v, surface).empty());
  const Positions before = v;
  EXPECT_GT(untangle(surface, &v), 0U);
  EXPECT_TRUE(turned_in_place(v, surface).empty());
  EXPECT_LT((v - before).rowwise().norm().maxCoeff(), 0.3);
}

TEST(Untangle, LeavesWhatIsNotTurned) {
  const TestMesh ball = sphere(4);
  const Surface surface(ball.topology, ball.positions.cast<float>().cast<double>());
  Positions v = surface.positions();
  EXPECT_EQ(untangle(surface, &v), 0U);
  EXPECT_EQ(v, surface.positions());
}

TEST(Untangle, TurnsTrianglesOfAnyConnectivity) {
  TestMesh sheet = flat_sheet(8);
  const TestMesh other = flat_sheet(15);
  Surface surface(other.topology, other.positions / 2);
  surface.build_index();
  sheet.positions.row(27) += Eigen::RowVector3d(1.1, 0.2, 0);
  ASSERT_FALSE(turned_triangles(sheet.topology, sheet.positions, surface).empty());
  Positions v = sheet.positions;
  EXPECT_GT(untangle(sheet.topology, surface, &v), 0U);
  EXPECT_TRUE(turned_triangles(sheet.topology, v, surface).empty());
  EXPECT_LT((v - sheet.positions).rowwise().norm().maxCoeff(), 0.5);
}

}  // namespace
}  // namespace anicodec
