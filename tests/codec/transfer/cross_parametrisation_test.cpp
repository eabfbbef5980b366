// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/cross_parametrisation.h"

#include "codec/sequence/error.h"
#include "tests/codec/massage_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

/// An egg of other faces.
TestMesh egg(uint32_t n) {
  TestMesh mesh = sphere(n);
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i)
    mesh.positions(i, 0) *= 1.2 + 0.15 * mesh.positions(i, 0);
  return mesh;
}

TEST(CrossParametrisation, LowersTheDistortionOfARoughMap) {
  const TestMesh ball = sphere(8), goal = egg(11);
  Surface surface(goal.topology, goal.positions);
  surface.build_index();
  // A map that crowds the vertices.
  Positions rough = ball.positions;
  for (uint32_t i = 0; i < ball.topology.vertex_count; ++i) {
    const Vector3d p = row(ball.positions, i);
    rough.row(i) = (p + 0.12 * Vector3d(std::sin(5 * p[1]), std::sin(6 * p[2]), std::sin(4 * p[0])))
                       .normalized()
                       .transpose();
  }
  const CrossParametrisation map = improve_map(ball.topology, ball.positions, surface, rough, {});
  EXPECT_LT(map.after.conformal_mean - 1, 0.5 * (map.before.conformal_mean - 1));
  EXPECT_EQ(map.turned, 0U);
  ASSERT_EQ(map.points.size(), ball.topology.vertex_count);
  for (uint32_t i = 0; i < ball.topology.vertex_count; ++i)
    EXPECT_LT(surface.closest(row(map.positions, i)).square_distance, 1e-12);
}

TEST(CrossParametrisation, KeepsLandmarks) {
  const TestMesh ball = sphere(6), goal = egg(9);
  Surface surface(goal.topology, goal.positions);
  surface.build_index();
  CrossParametrisationOptions options;
  options.landmarks = {
      {3, surface.closest(row(ball.positions, 3) + Vector3d(0, 0.05, 0)).position}};
  const CrossParametrisation map =
      improve_map(ball.topology, ball.positions, surface, ball.positions, options);
  EXPECT_LT((row(map.positions, 3) - options.landmarks[0].position).norm(), 1e-3);
}

TEST(CrossParametrisation, MakesAMapOfLandmarks) {
  const TestMesh ball = sphere(8), goal = egg(10);
  Surface surface(goal.topology, goal.positions);
  surface.build_index();
  std::vector<Landmark> landmarks;
  for (uint32_t i : {0U, 40U, 90U, 150U, 200U})
    landmarks.push_back({i, surface.closest(row(ball.positions, i)).position});
  const Positions map = map_by_landmarks(ball.topology, ball.positions, surface, landmarks);
  double sum = 0;
  for (uint32_t i = 0; i < ball.topology.vertex_count; ++i)
    sum += std::sqrt(surface.closest(row(map, i)).square_distance);
  EXPECT_LT(sum / ball.topology.vertex_count, 0.02);
  EXPECT_TRUE(turned_triangles(ball.topology, map, surface).empty());
}

TEST(CrossParametrisation, RefusesWhatCannotBe) {
  const TestMesh ball = sphere(6), sheet = flat_sheet(6);
  Surface surface(sheet.topology, sheet.positions);
  surface.build_index();
  EXPECT_THROW(improve_map(ball.topology, ball.positions, surface, ball.positions, {}), Error);
  Surface closed(ball.topology, ball.positions);
  closed.build_index();
  CrossParametrisationOptions options;
  options.landmarks = {{100000, Vector3d::Zero()}};
  EXPECT_THROW(improve_map(ball.topology, ball.positions, closed, ball.positions, options), Error);
  EXPECT_THROW(map_by_landmarks(ball.topology, ball.positions, closed,
                                {{0, Vector3d::UnitX()}, {1, Vector3d::UnitY()}}),
               Error);
}

}  // namespace
}  // namespace anicodec
