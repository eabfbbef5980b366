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

SurfaceFrame frame_of(const TestMesh& mesh) {
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
  const SurfaceFrame ball = frame_of(sphere(8)), egg = frame_of(distant_egg(8));
  std::vector<VertexPair> pairs;
  for (uint32_t v : {0U, 40U, 90U, 150U, 200U})
    pairs.push_back({v, v});
  const MeshMap map = map_mesh(ball, egg, pairs);
  EXPECT_EQ(map.positions.size(), ball.positions.size());
  EXPECT_LT(map.distance.mean(), 0.01 * map.diagonal);
  EXPECT_LE(map.after.conformal_mean, map.before.conformal_mean);
  EXPECT_EQ(map.turned, 0U);
}

TEST(MeshMap, NeedsNoLandmarksForMeshesOverEachOther) {
  const MeshMap map = map_mesh(frame_of(sphere(6)), frame_of(sphere(9)), {});
  EXPECT_LT(map.distance.max(), 0.05 * map.diagonal);
  EXPECT_LT(map.after.conformal_mean, 1.1);
}

TEST(MeshMap, RefusesWhatCannotBeMapped) {
  const SurfaceFrame ball = frame_of(sphere(6)), sheet = frame_of(flat_sheet(6));
  EXPECT_THROW(map_mesh(ball, sheet, {}), Error);
  EXPECT_THROW(map_mesh(ball, SurfaceFrame(), {}), Error);
  EXPECT_THROW(map_mesh(ball, ball, std::vector<VertexPair>{{0, 0}, {1, 1}, {99999, 2}}), Error);
  const std::vector<VertexPair> line = {{0, 0}, {1, 1}, {2, 2}};
  EXPECT_THROW(map_mesh(sheet, sheet, line), Error);
}

}  // namespace
}  // namespace anicodec
