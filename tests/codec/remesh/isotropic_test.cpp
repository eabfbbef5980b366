// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/isotropic.h"

#include "codec/metrics/hausdorff.h"
#include "codec/surface/mesh_quality.h"
#include "tests/codec/remesh/remesh_meshes.h"

namespace anicodec {
namespace {

SurfaceFrame even(uint32_t vertices, const SurfaceFrame& mesh) {
  IsotropicOptions options;
  options.vertices = vertices;
  return remesh_isotropic(mesh, options);
}

double ratio_of(const SurfaceFrame& mesh) {
  return radius_ratio(topology_of(mesh), positions_of(mesh.positions)).mean;
}

double distance(const SurfaceFrame& a, const SurfaceFrame& b) {
  return hausdorff(a.polygons, a.positions, b.polygons, b.positions).max();
}

TEST(Isotropic, EvensOutABall) {
  const SurfaceFrame ball = frame_of(sphere(16));
  for (uint32_t vertices : {300U, 1000U, 4000U}) {
    const SurfaceFrame result = even(vertices, ball);
    EXPECT_NEAR(static_cast<double>(vertices_of(result)), vertices, 0.02 * vertices);
    EXPECT_GT(ratio_of(result), 0.95) << vertices;
    EXPECT_LT(distance(result, ball), 0.025) << vertices;
    expect_manifold(result, true);
  }
}

TEST(Isotropic, KeepsCreasesAndCorners) {
  const SurfaceFrame result = even(1000, cube());
  for (float x : {0.0F, 1.0F}) {
    for (float y : {0.0F, 1.0F}) {
      EXPECT_TRUE(has_vertex(result, {x, y, 0}));
      EXPECT_TRUE(has_vertex(result, {x, y, 1}));
    }
  }
  EXPECT_LT(distance(result, cube()), 1e-6);
  EXPECT_NEAR(area_of(result), 6, 1e-5);
  EXPECT_GT(ratio_of(result), 0.9);
  expect_manifold(result, true);
}

TEST(Isotropic, KeepsTheOutlineOfASheet) {
  const SurfaceFrame result = even(500, frame_of(flat_sheet(8)));
  EXPECT_NEAR(area_of(result), 49, 1e-4);
  EXPECT_GT(ratio_of(result), 0.9);
  expect_manifold(result, false);
}

TEST(Isotropic, TakesSliversAndComponents) {
  const SurfaceFrame result = even(400, both(double_cone(500), frame_of(sphere(6), {4, 0, 0})));
  EXPECT_GT(ratio_of(result), 0.85);
  expect_manifold(result, true);
}

TEST(Isotropic, TakesASingleTriangle) {
  const SurfaceFrame result = even(100, mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0}, {{0, 1, 2}}));
  EXPECT_NEAR(area_of(result), 0.5, 1e-6);
  EXPECT_GT(vertices_of(result), 80U);
  expect_manifold(result, false);
}

TEST(Isotropic, RefusesASurfaceWithoutArea) {
  expect_error(
      [] {
        even(100, mesh_of({0, 0, 0, 1, 0, 0, 2, 0, 0}, {{0, 1, 2}}));
      },
      ErrorKind::kInput, "without area");
  expect_error([] { even(0, cube()); }, ErrorKind::kUsage, "number of vertices");
}

}  // namespace
}  // namespace anicodec
