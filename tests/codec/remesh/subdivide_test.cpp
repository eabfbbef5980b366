// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/subdivide.h"

#include "tests/codec/remesh/remesh_meshes.h"

namespace anicodec {
namespace {

TEST(Subdivide, CutsEachTriangleIntoFour) {
  const SurfaceFrame ball = frame_of(sphere(4));
  const SurfaceFrame once = subdivide(ball, 1), twice = subdivide(ball, 2);
  const size_t edges = ball.polygons.size() * 3 / 2;
  EXPECT_EQ(vertices_of(once), vertices_of(ball) + edges);
  EXPECT_EQ(once.polygons.size(), 4 * ball.polygons.size());
  EXPECT_EQ(twice.polygons.size(), 16 * ball.polygons.size());
  expect_manifold(twice, true);
}

TEST(Subdivide, SmoothsByLoopsWeights) {
  // An octahedron: valence 4 has the weights 1 - a and a / 4 for a = (40 - 3^2) / 64.
  const SurfaceFrame fine = subdivide(
      mesh_of(
          {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}),
      1);
  EXPECT_FLOAT_EQ(fine.positions[0], 1 - 31.0F / 64);
  EXPECT_FLOAT_EQ(fine.positions[1], 0);
  EXPECT_TRUE(has_vertex(fine, {0.375, 0.375, 0})) << "3/8 of either end and 1/8 of those beside";
}

TEST(Subdivide, KeepsAFlatSheetFlat) {
  const SurfaceFrame fine = subdivide(frame_of(flat_sheet(5)), 2);
  expect_manifold(fine, false);
  for (size_t v = 0; v < vertices_of(fine); ++v)
    EXPECT_EQ(fine.positions[3 * v + 2], 0);
  EXPECT_TRUE(has_vertex(fine, {2, 2, 0}));
}

TEST(Subdivide, TakesAnyValence) {
  const SurfaceFrame fine = subdivide(double_cone(300), 1);
  // The hub moves 3/8 of the way (the limit of Loop's weight) to the middle of the rim.
  EXPECT_NEAR(fine.positions[2], 1 - 15.0 / 64, 1e-3);
  expect_manifold(fine, true);
}

TEST(Subdivide, GivesEveryFrameTheSameFaces) {
  MeshSequence clip = single_frame(frame_of(sphere(3)));
  clip.name = "ball";
  clip.loop = true;
  clip.frame_count = 2;
  for (size_t i = 0, n = clip.positions.size(); i < n; ++i)
    clip.positions.push_back(2 * clip.positions[i]);
  const MeshSequence fine = subdivide(clip, 1);
  ASSERT_EQ(fine.frame_count, 2U);
  check(fine);
  EXPECT_EQ(fine.name, "ball");
  EXPECT_TRUE(fine.loop);
  for (size_t i = 0; i < fine.frame(0).size(); ++i)
    EXPECT_FLOAT_EQ(fine.frame(1)[i], 2 * fine.frame(0)[i]);
}

TEST(Subdivide, RefusesWhatWouldBeTooLarge) {
  expect_error([] { subdivide(frame_of(sphere(4)), 30); }, ErrorKind::kInput, "too large");
}

TEST(Subdivide, TellsWhatItLeftOut) {
  SurfaceFrame mesh = frame_of(sphere(4));
  mesh.polygons.add(std::array<uint32_t, 3>{3, 3, 4});
  MeshRepairs repairs;
  subdivide(mesh, 1, &repairs);
  EXPECT_EQ(repairs.degenerate, 1U);
}

}  // namespace
}  // namespace anicodec
