// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/registration.h"

#include "tests/codec/massage_meshes.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

TEST(Registration, PosesByLandmarksAlone) {
  // A ball is turned by more than a right angle and put elsewhere; nine of its vertices tell.
  const TestMesh ball = sphere(8);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.8, Vector3d(1, 2, 3).normalized()).matrix();
  const Vector3d shift(3, -1, 2);
  std::vector<Landmark> landmarks;
  for (uint32_t i = 0; i < ball.topology.vertex_count; i += ball.topology.vertex_count / 8)
    landmarks.push_back({i, turn * row(ball.positions, i) + shift});
  const RigidShape shape(ball.topology, ball.positions);
  Registration registration(ball.topology, shape);
  Positions v = ball.positions;
  registration.pose(landmarks, &v);
  double most = 0;
  for (uint32_t i = 0; i < ball.topology.vertex_count; ++i)
    most = std::max(most, (row(v, i) - turn * row(ball.positions, i) - shift).norm());
  EXPECT_LT(most, 0.2);
}

TEST(Registration, StaysWithoutLandmarks) {
  const TestMesh ball = sphere(6);
  const RigidShape shape(ball.topology, ball.positions);
  Registration registration(ball.topology, shape);
  Positions v = ball.positions;
  registration.pose({}, &v);
  EXPECT_LT((v - ball.positions).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace anicodec
