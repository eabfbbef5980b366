// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/remesh.h"

#include "tests/codec/remesh/remesh_meshes.h"

namespace anicodec {
namespace {

RemeshResult remeshed(const SurfaceFrame& mesh, uint32_t vertices,
                      RemeshMethod method = RemeshMethod::kAuto) {
  RemeshOptions options;
  options.vertices = vertices;
  options.method = method;
  return remesh(mesh, options);
}

TEST(Remesh, FitsFewerVerticesToTheSurface) {
  const RemeshResult result = remeshed(frame_of(sphere(14)), 120);
  EXPECT_EQ(result.method, RemeshMethod::kDecimate);
  EXPECT_EQ(vertices_of(result.mesh), 120U);
  EXPECT_TRUE(result.fit.improved);
  EXPECT_LT(result.fit.after.mean(), 0.6 * result.fit.before.mean());
  EXPECT_LT(result.fit.after.max(), 0.6 * result.fit.before.max());
  expect_manifold(result.mesh, true);
}

TEST(Remesh, CoversTheSurfaceWithMoreVertices) {
  const RemeshResult result = remeshed(frame_of(sphere(6)), 700);
  EXPECT_EQ(result.method, RemeshMethod::kIsotropic);
  EXPECT_EQ(vertices_of(result.mesh), 700U);
  EXPECT_LT(result.fit.after.max() / result.fit.diagonal, 0.02);
}

TEST(Remesh, SmoothsByLoop) {
  const RemeshResult result = remeshed(cube(), 300, RemeshMethod::kLoop);
  EXPECT_EQ(vertices_of(result.mesh), 300U);
  EXPECT_FALSE(has_vertex(result.mesh, {0, 0, 0}));
  EXPECT_LT(result.fit.after.max() / result.fit.diagonal, 0.02) << "from the subdivided cube";
}

TEST(Remesh, FindsTheNumberForADistance) {
  RemeshOptions options;
  options.max_distance = 0.02;
  options.fit = false;
  const RemeshResult result = remesh(frame_of(sphere(14)), options);
  EXPECT_LT(vertices_of(result.mesh), 400U);
  EXPECT_FALSE(result.fit.improved);
  EXPECT_EQ(result.fit.before.max(), result.fit.after.max());
  options.method = RemeshMethod::kIsotropic;
  expect_error([&] { remesh(cube(), options); }, ErrorKind::kUsage, "only decimation");
}

TEST(Remesh, SaysWhyItCouldNotFit) {
  // So far from the ball that they no longer stand for each other.
  const SurfaceFrame two = both(frame_of(sphere(12)), frame_of(sphere(12), {3, 0, 0}));
  const RemeshResult result = remeshed(two, 8);
  EXPECT_EQ(result.mesh.positions, result.fit.positions);
  EXPECT_TRUE(result.no_fit.empty() || !result.fit.improved);
}

TEST(Remesh, RefusesNonManifoldMeshes) {
  expect_error(
      [] {
        remeshed(mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1},
                         {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),
                 4);
      },
      ErrorKind::kInput, "has 3 faces");
}

}  // namespace
}  // namespace anicodec
