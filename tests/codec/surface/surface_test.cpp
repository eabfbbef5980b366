// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface.h"

#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

TEST(Surface, NormalsOfASpherePointOutwards) {
  const TestMesh ball = sphere(6);
  const Positions normals = vertex_normals(ball.topology, ball.positions);
  for (uint32_t i = 0; i < ball.topology.vertex_count; ++i)
    EXPECT_GT(row(normals, i).dot(row(ball.positions, i)), 0.98);
}

TEST(Surface, WalkingMostTimesFindsWhatTheIndexFinds) {
  const TestMesh ball = sphere(8);
  Surface surface(ball.topology, ball.positions);
  surface.build_index();
  std::mt19937 random(1);
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const uint32_t v = static_cast<uint32_t>(random() % ball.topology.vertex_count);
    Vector3d q = 1.05 * row(ball.positions, v);
    for (int axis = 0; axis < 3; ++axis)
      q[axis] += 0.1 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
    const SurfacePoint walked = surface.walk(q, ball.topology.star[v][0]);
    const double best = surface.closest(q).square_distance;
    EXPECT_GE(walked.square_distance, best - 1e-12);
    found += walked.square_distance < best + 1e-12;
    EXPECT_NEAR((walked.position - q).squaredNorm(), walked.square_distance, 1e-12);
  }
  EXPECT_GT(found, 450);  // the others are local minima
}

TEST(Surface, WalksAlongTheBoundary) {
  const TestMesh sheet = flat_sheet(6);
  const Surface surface(sheet.topology, sheet.positions);
  uint32_t start = 1;
  Vector3d direction;
  const SurfacePoint point = surface.walk_boundary({3.3, -1, 0}, &start, &direction);
  EXPECT_NEAR((point.position - Vector3d(3.3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(start, 3U);
  EXPECT_NEAR(std::abs(direction[0]), 1, 1e-12);
}

TEST(Surface, FindsTheClosestPointOfTheBoundary) {
  const TestMesh sheet = flat_sheet(6);
  Surface surface(sheet.topology, sheet.positions);
  surface.build_index();
  Vector3d direction;
  const Vector3d found = surface.closest_on_boundary({4.5, 2.25, 0.5}, &direction);
  EXPECT_NEAR((found - Vector3d(5, 2.25, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR(std::abs(direction[1]), 1, 1e-12);
}

TEST(Surface, CurvesOverBluntEdgesButNotOverSharpOnes) {
  // How far a roof bulges over the middle of its first triangle, a corner of which is on the ridge.
  auto bulge = [](double slope) {
    const TestMesh roof =
        height_field(3, [slope](double x, double) { return -slope * std::abs(x - 1); });
    const Surface surface(roof.topology, roof.positions);
    SurfacePoint middle;
    middle.triangle = 0;
    middle.weights = Vector3d::Constant(1.0 / 3);
    for (uint32_t corner : roof.topology.triangles[0])
      middle.position += row(roof.positions, corner) / 3;
    return (surface.curved(middle) - middle.position).norm();
  };
  EXPECT_GT(bulge(0.2), 0.01);
  EXPECT_EQ(bulge(1), 0);
}

TEST(Surface, WithoutTrianglesHasNoIndex) {
  const SurfaceTopology topology({}, 1);
  Surface surface(topology, Positions::Zero(1, 3));
  EXPECT_THROW(surface.build_index(), Error);
}

TEST(Surface, RoundsPositionsToFloats) {
  Positions v = Positions::Random(50, 3);
  for (uint32_t i = 0; i < 49; ++i) {
    v.row(i) = float_position(row(v, i + 1) + 0.5 * (row(v, i) - row(v, i + 1))).transpose();
    std::vector<float> floats(3);
    for (int k = 0; k < 3; ++k)
      floats[static_cast<size_t>(k)] = static_cast<float>(v(i, k));
    EXPECT_EQ(positions_of(floats), v.row(i));
  }
}

}  // namespace
}  // namespace anicodec
