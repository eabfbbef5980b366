// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/mesh_map.h"

#include "codec/sequence/error.h"
#include "tests/codec/massage_meshes.h"

#include <utility>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

SurfaceFrame map_frame(const TestMesh& mesh) {
  SurfaceFrame frame;
  for (const SurfaceTopology::Triangle& t : mesh.topology.triangles)
    frame.polygons.add(t);
  for (uint32_t v = 0; v < mesh.topology.vertex_count; ++v) {
    for (int k = 0; k < 3; ++k)
      frame.positions.push_back(static_cast<float>(mesh.positions(v, k)));
  }
  return frame;
}

/// An egg that lies elsewhere, turned and twice as large.
TestMesh distant_egg(uint32_t n) {
  TestMesh mesh = sphere(n);
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i) {
    const Vector3d p = row(mesh.positions, i);
    mesh.positions.row(i) =
        (2 * Vector3d(-p[1], (1.2 + 0.15 * p[0]) * p[0], p[2]) + Vector3d(7, 0, -3)).transpose();
  }
  return mesh;
}

TEST(MeshMap, LaysAMeshOnADistantOneByLandmarks) {
  const SurfaceFrame ball = map_frame(sphere(8)), egg = map_frame(distant_egg(8));
  std::vector<VertexPair> pairs;
  for (uint32_t v : {0U, 40U, 90U, 150U, 200U})
    pairs.push_back({v, v});
  const MeshMap map = map_mesh(ball, egg, pairs);
  EXPECT_EQ(map.positions.size(), ball.positions.size());
  EXPECT_LT(map.distance.mean(), 0.01 * map.diagonal);
  EXPECT_LE(map.after.conformal_mean, map.before.conformal_mean);
  EXPECT_EQ(map.turned, 0U);
}

Vector3d position_of(const MeshPoint& point, const SurfaceFrame& surface) {
  Vector3d p = Vector3d::Zero();
  for (size_t k = 0; k < 3; ++k) {
    const float* v = &surface.positions[3 * size_t{surface.polygons.corners[point.corners[k]]}];
    p += point.weights[k] * Vector3d(double{v[0]}, double{v[1]}, double{v[2]});
  }
  return p;
}

TEST(MeshMap, TellsWhereVerticesAndCornersLieOnTheSurface) {
  const SurfaceFrame ball = map_frame(sphere(6)), fine = map_frame(sphere(9));
  const MeshMap map = map_mesh(ball, fine, {});
  const Positions at = positions_of(map.positions);
  ASSERT_EQ(map.points.size() * 3, ball.positions.size());
  ASSERT_EQ(map.corners.size(), ball.polygons.corners.size());
  for (uint32_t v = 0; v < map.points.size(); ++v)
    EXPECT_LT((position_of(map.points[v], fine) - row(at, v)).norm(), 1e-5);
  for (size_t c = 0; c < map.corners.size(); ++c) {
    EXPECT_LT((position_of(map.corners[c], fine) - row(at, ball.polygons.corners[c])).norm(), 0.02);
    EXPECT_LT(map.corners[c].polygon, fine.polygons.size());
  }
}

TEST(MeshMap, NeedsNoLandmarksForMeshesOverEachOther) {
  const MeshMap map = map_mesh(map_frame(sphere(6)), map_frame(sphere(9)), {});
  EXPECT_LT(map.distance.max(), 0.05 * map.diagonal);
  EXPECT_LT(map.after.conformal_mean, 1.1);
}

TEST(MeshMap, RefusesWhatCannotBeMapped) {
  const SurfaceFrame ball = map_frame(sphere(6)), sheet = map_frame(flat_sheet(6));
  EXPECT_THROW(map_mesh(ball, sheet, {}), Error);
  EXPECT_THROW(map_mesh(ball, SurfaceFrame(), {}), Error);
  EXPECT_THROW(map_mesh(ball, ball, std::vector<VertexPair>{{0, 0}, {1, 1}, {99999, 2}}), Error);
  const std::vector<VertexPair> line = {{0, 0}, {1, 1}, {2, 2}};
  EXPECT_THROW(map_mesh(sheet, sheet, line), Error);
}

}  // namespace
}  // namespace anicodec
