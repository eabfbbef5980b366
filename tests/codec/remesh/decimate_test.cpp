// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/decimate.h"

#include "codec/metrics/hausdorff.h"
#include "tests/codec/remesh/remesh_meshes.h"

#include <stdexcept>
#include <string_view>

namespace anicodec {
namespace {

Decimation to(uint32_t vertices, const SurfaceFrame& mesh) {
  DecimationOptions options;
  options.vertices = vertices;
  return decimate(mesh, options);
}

TEST(Decimate, KeepsSomeVerticesOfABall) {
  const SurfaceFrame ball = frame_of(sphere(12));
  const Decimation result = to(100, ball);
  ASSERT_EQ(result.vertices.size(), 100U);
  EXPECT_EQ(result.mesh.polygons.size(), 196U);
  expect_manifold(result.mesh, true);
  for (size_t v = 0; v < 100; ++v) {
    for (size_t k = 0; k < 3; ++k)
      EXPECT_EQ(result.mesh.positions[3 * v + k], ball.positions[3 * result.vertices[v] + k]);
  }
  EXPECT_LT(
      hausdorff(result.mesh.polygons, result.mesh.positions, ball.polygons, ball.positions).max(),
      0.06);
}

TEST(Decimate, LeavesAMeshThatIsSmallEnough) {
  const SurfaceFrame ball = frame_of(sphere(3));
  const Decimation result = to(1000, ball);
  EXPECT_EQ(result.mesh.positions, ball.positions);
  EXPECT_EQ(result.mesh.polygons.size(), ball.polygons.size());
}

TEST(Decimate, KeepsTheOutlineOfASheet) {
  const Decimation result = to(12, frame_of(flat_sheet(20)));
  EXPECT_EQ(result.vertices.size(), 12U);
  for (const auto& corner : {std::array<float, 3>{0, 0, 0}, {19, 0, 0}, {0, 19, 0}, {19, 19, 0}})
    EXPECT_TRUE(has_vertex(result.mesh, corner));
  EXPECT_NEAR(area_of(result.mesh), 19 * 19, 1e-3);
  expect_manifold(result.mesh, false);
}

TEST(Decimate, DependsOnNoUnits) {
  const SurfaceFrame ball = frame_of(sphere(8));
  const std::vector<uint32_t> vertices = to(60, ball).vertices;
  for (float scale : {0x1p-60F, 0x1p60F}) {
    SurfaceFrame scaled = ball;
    for (float& x : scaled.positions)
      x *= scale;
    EXPECT_EQ(to(60, scaled).vertices, vertices) << scale;
  }
}

TEST(Decimate, StopsAtADistance) {
  const SurfaceFrame ball = frame_of(sphere(16));
  DecimationOptions options;
  size_t last = vertices_of(ball);
  for (double distance : {0.003, 0.01, 0.03}) {
    options.max_distance = distance;
    const Decimation result = decimate(ball, options);
    EXPECT_LT(result.vertices.size(), last);
    last = result.vertices.size();
    const Polygons none;
    EXPECT_LE(
        hausdorff(none, ball.positions, result.mesh.polygons, result.mesh.positions).forward.max,
        1.000001 * distance);
  }
}

TEST(Decimate, StopsWhereNothingCanGo) {
  EXPECT_EQ(to(1, mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0}, {{0, 1, 2}})).vertices.size(), 3U);
  const SurfaceFrame two = both(frame_of(sphere(6)), frame_of(sphere(5), {5, 0, 0}));
  const Decimation result = to(1, two);
  EXPECT_GE(result.vertices.size(), 8U);
  EXPECT_LT(result.vertices.size(), 40U);
  expect_manifold(result.mesh, true);
  EXPECT_GT(result.vertices.back(), 200U) << "a component is gone";
}

TEST(Decimate, TellsWhatItLeftOut) {
  SurfaceFrame mesh = frame_of(sphere(6));
  mesh.polygons.add(std::array<uint32_t, 3>{3, 3, 4});
  EXPECT_EQ(to(50, mesh).repairs.degenerate, 1U);
}

TEST(Decimate, TakesHubs) {
  const Decimation result = to(60, double_cone(5000));
  EXPECT_EQ(result.vertices.size(), 60U);
  EXPECT_EQ(result.vertices[0], 0U);
  EXPECT_EQ(result.vertices[1], 1U);
  expect_manifold(result.mesh, true);
}

TEST(Decimate, CanBeCancelled) {
  const auto cancel = [](std::string_view stage, double done) {
    EXPECT_EQ(stage, "decimating");
    EXPECT_LE(done, 1);
    throw std::runtime_error("enough");
  };
  DecimationOptions options;
  options.vertices = 10;
  EXPECT_THROW(decimate(frame_of(sphere(20)), options, cancel), std::runtime_error);
}

TEST(Decimate, RefusesWhatItCannotDo) {
  expect_error([] { decimate(cube(), {}); }, ErrorKind::kUsage, "a number of vertices");
  expect_error([] { to(4, mesh_of({0, 0, 0}, {})); }, ErrorKind::kInput, "without faces");
}

}  // namespace
}  // namespace anicodec
