// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/mesh_quality.h"

#include "codec/massage/untangle.h"
#include "codec/metrics/hausdorff.h"
#include "tests/codec/massage_meshes.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using testing::ElementsAre;

TestMesh triangle(double x, double y) {
  TestMesh mesh;
  const std::vector<uint32_t> corners{0, 1, 2};
  mesh.topology = SurfaceTopology(corners, 3);
  mesh.positions = Positions::Zero(3, 3);
  mesh.positions.row(1) << 1, 0, 0;
  mesh.positions.row(2) << x, y, 0;
  return mesh;
}

TEST(MeshQuality, RadiusRatioIsOneForEquilateralTriangles) {
  const TestMesh even = triangle(0.5, std::sqrt(0.75)), right = triangle(0, 1);
  EXPECT_NEAR(radius_ratio(even.topology, even.positions).mean, 1, 1e-12);
  EXPECT_NEAR(radius_ratio(right.topology, right.positions).least, 2 * (std::sqrt(2.0) - 1), 1e-12);
  const TestMesh flat = triangle(2, 0);
  EXPECT_EQ(radius_ratio(flat.topology, flat.positions).mean, 0);
}

TEST(MeshQuality, DistortionOfAStretchIsItsRatio) {
  const TestMesh mesh = flat_sheet(4);
  Positions stretched = mesh.positions;
  stretched.col(0) *= 2;
  const Distortion d = distortion(mesh.topology, mesh.positions, stretched);
  EXPECT_NEAR(d.conformal_mean, 1.25, 1e-12);
  EXPECT_NEAR(d.conformal_max, 1.25, 1e-12);
  EXPECT_NEAR(d.area_mean, 1, 1e-12);
}

TEST(MeshQuality, DistortionIgnoresScaleAndRotation) {
  const TestMesh ball = sphere(3);
  Positions turned = 5 * ball.positions;
  turned.col(0).swap(turned.col(1));
  turned.col(0) *= -1;
  const Distortion d = distortion(ball.topology, ball.positions, turned);
  EXPECT_NEAR(d.conformal_max, 1, 1e-9);
  EXPECT_NEAR(d.area_max, 1, 1e-9);
}

TEST(MeshQuality, AreaDistortionIsRelativeToTheWhole) {
  TestMesh mesh = flat_sheet(3);
  Positions moved = mesh.positions;
  moved.row(4) << 0.5, 1, 0;
  EXPECT_GT(distortion(mesh.topology, mesh.positions, moved).area_max, 1.2);
}

TEST(MeshQuality, DegenerateTrianglesStayFinite) {
  TestMesh mesh = flat_sheet(3);
  Positions moved = mesh.positions;
  moved.row(4) = moved.row(3);
  EXPECT_TRUE(std::isfinite(distortion(mesh.topology, mesh.positions, moved).conformal_mean));
  EXPECT_LE(distortion(mesh.topology, moved, mesh.positions).conformal_mean, 20);
}

TEST(MeshQuality, FindsTurnedTriangles) {
  TestMesh mesh = flat_sheet(4);
  Surface surface(mesh.topology, mesh.positions);
  surface.build_index();
  EXPECT_TRUE(turned_triangles(mesh.topology, mesh.positions, surface).empty());
  Positions moved = mesh.positions;
  moved.row(5) << 1.2, -0.5, 0;
  EXPECT_FALSE(turned_triangles(mesh.topology, moved, surface).empty());
}

TEST(MeshQuality, TwoSidesOfASheetAreNotTurned) {
  TestMesh mesh = flat_sheet(4);
  Surface surface(mesh.topology, mesh.positions);
  surface.build_index();
  const std::vector<uint32_t> both = {0, 1, 4, 0, 4, 1};
  auto turned = [&](std::span<const uint32_t> corners) {
    return turned_triangles(SurfaceTopology(corners, 16), mesh.positions, surface).size();
  };
  EXPECT_EQ(turned(std::span(both).first(3)) + turned(std::span(both).last(3)), 1U);
  EXPECT_EQ(turned(both), 0U);
}

TEST(MeshQuality, DoesNotMistakeTheFarSideOfAThinPart) {
  // A plate, thinner than its triangles are off it.
  const TestMesh top = flat_sheet(6);
  std::vector<uint32_t> corners;
  Positions both(2 * top.positions.rows(), 3);
  both << top.positions, top.positions;
  both.col(2).tail(top.positions.rows()).setConstant(-0.01);
  for (const SurfaceTopology::Triangle& t : top.topology.triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  const size_t count = corners.size();
  for (size_t c = 0; c < count; c += 3) {
    for (size_t k : {size_t{0}, size_t{2}, size_t{1}})
      corners.push_back(corners[c + k] + top.topology.vertex_count);
  }
  const SurfaceTopology plate(corners, 2 * top.topology.vertex_count);
  Surface surface(plate, both);
  surface.build_index();
  Positions v = top.positions;
  v.row(14)[2] = -0.05;  // its triangles lie below the plate
  EXPECT_TRUE(turned_triangles(top.topology, v, surface).empty());
}

}  // namespace
}  // namespace anicodec
