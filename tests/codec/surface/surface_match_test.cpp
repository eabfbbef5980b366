// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_match.h"

#include "codec/sequence/error.h"
#include "tests/codec/massage_meshes.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// A sphere without some of its triangles, which are next to one another.
SurfaceTopology without(const TestMesh& mesh, size_t triangles) {
  std::vector<uint32_t> corners;
  for (size_t t = triangles; t < mesh.topology.triangles.size(); ++t)
    corners.insert(corners.end(), mesh.topology.triangles[t].begin(),
                   mesh.topology.triangles[t].end());
  return {corners, mesh.topology.vertex_count};
}

TEST(SurfaceMatch, ClosedMeshesStandForOnesWithASmallOpening) {
  const TestMesh ball = sphere(24);
  EXPECT_EQ(largest_opening(ball.topology, ball.positions), 0);
  Surface closed(ball.topology, ball.positions);
  closed.build_index();
  EXPECT_EQ(check_openings(ball.topology, ball.positions, closed), 0);
  const SurfaceTopology slit = without(ball, 1),
                        half = without(ball, ball.topology.triangles.size() / 2);
  const double opening = largest_opening(slit, ball.positions);
  EXPECT_GT(opening, 0);
  EXPECT_LT(opening, 0.05);
  EXPECT_EQ(check_openings(slit, ball.positions, closed), opening);
  EXPECT_GT(largest_opening(half, ball.positions), 0.3);
  EXPECT_THROW(check_openings(half, ball.positions, closed), Error);
  EXPECT_THROW(check_surfaces_match(half, ball.positions, closed), Error);
  check_surfaces_match(slit, ball.positions, closed);
}

}  // namespace
}  // namespace anicodec
