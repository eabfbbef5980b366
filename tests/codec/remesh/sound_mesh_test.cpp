// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/sound_mesh.h"

#include "tests/codec/remesh/remesh_meshes.h"

#include <limits>

namespace anicodec {
namespace {

SoundMesh sound(const SurfaceFrame& mesh) {
  return sound_mesh(single_frame(mesh));
}

void expect_refused(const SurfaceFrame& mesh, const std::string& text) {
  expect_error([&] { sound(mesh); }, ErrorKind::kInput, text);
}

TEST(SoundMesh, CutsPolygonsAndLeavesOutUnusedVertices) {
  SurfaceFrame mesh = cube();
  mesh.positions.insert(mesh.positions.begin(), {9, 9, 9});
  for (uint32_t& c : mesh.polygons.corners)
    ++c;
  const SoundMesh result = sound(mesh);
  EXPECT_EQ(result.triangles.size(), 12U);
  EXPECT_EQ(result.source, (std::vector<uint32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_FALSE(result.repairs.any());
  EXPECT_EQ(result.frame(mesh.positions).row(0), Eigen::RowVector3d(0, 0, 0));
}

TEST(SoundMesh, CutsConcavePolygonsSoThatTrianglesCoverThemOnce) {
  SurfaceFrame mesh;  // an L of area 5 that begins at a corner from which no fan covers it
  mesh.positions = {3, 0, 0, 3, 1, 0, 1, 1, 0, 1, 3, 0, 0, 3, 0, 0, 0, 0};
  mesh.polygons.add(std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  const SoundMesh result = sound(mesh);
  ASSERT_EQ(result.triangles.size(), 4U);
  const Positions places = result.frame(mesh.positions);
  double whole = 0;
  for (const auto& t : result.triangles) {
    const Eigen::RowVector3d a = places.row(t[1]) - places.row(t[0]),
                             b = places.row(t[2]) - places.row(t[0]);
    EXPECT_GT(a.cross(b)[2], 0);
    whole += a.cross(b)[2] / 2;
  }
  EXPECT_DOUBLE_EQ(whole, 5);
}

TEST(SoundMesh, WeldsSeams) {
  // Two triangles of a sheet, with vertices of their own.
  const SurfaceFrame mesh =
      mesh_of({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}, {{0, 1, 2}, {3, 4, 5}});
  const SoundMesh result = sound(mesh);
  EXPECT_EQ(result.source, (std::vector<uint32_t>{0, 1, 2, 5}));
  EXPECT_FALSE(result.repairs.any());
}

TEST(SoundMesh, LeavesOutDegenerateAndRepeatedTriangles) {
  const SurfaceFrame mesh = mesh_of({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0},
                                    {{0, 1, 2}, {2, 0, 1}, {0, 2, 3}, {1, 1, 3}, {0, 4, 1}});
  const SoundMesh result = sound(mesh);
  EXPECT_EQ(result.triangles.size(), 2U);
  EXPECT_EQ(result.repairs.degenerate, 2U);  // one of them has a vertex twice at one place
  EXPECT_EQ(result.repairs.repeated, 1U);
}

TEST(SoundMesh, PartsFansThatTouchInAVertex) {
  const SurfaceFrame mesh =
      mesh_of({0, 0, 0, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0}, {{0, 1, 2}, {0, 3, 4}});
  const SoundMesh result = sound(mesh);
  EXPECT_EQ(result.repairs.parted, 1U);
  EXPECT_EQ(result.source, (std::vector<uint32_t>{0, 0, 1, 2, 3, 4}));
  EXPECT_NE(result.triangles[0][0], result.triangles[1][0]);
}

TEST(SoundMesh, PartsClosedFansThatTouchInAVertex) {
  SurfaceFrame mesh = both(cube(), cube(1));
  // The second cube is pushed away but for one corner.
  for (size_t v = 8; v < 16; ++v) {
    if (v != 8)
      mesh.positions[3 * v] += 5;
  }
  const SoundMesh result = sound(mesh);
  EXPECT_EQ(result.repairs.parted, 1U);
  EXPECT_EQ(result.source.size(), 16U);
}

TEST(SoundMesh, KeepsPartsApartThatTouchAlongAnEdge) {
  SurfaceFrame mesh = both(cube(), cube(1));
  for (size_t v = 8; v < 16; ++v)
    mesh.positions[3 * v + 1] += 1;
  const SoundMesh result = sound(mesh);
  EXPECT_EQ(result.source.size(), 16U);
  EXPECT_EQ(result.triangles.size(), 24U);
}

TEST(SoundMesh, RefusesAnEdgeOfThreeFaces) {
  expect_refused(
      mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),
      "the edge between vertices 0 and 1 has 3 faces");
}

TEST(SoundMesh, RefusesFacesWoundUnlike) {
  expect_refused(mesh_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0}, {{0, 1, 2}, {0, 1, 3}}),
                 "the edge between vertices 0 and 1 has two faces that are wound in opposite ways");
}

TEST(SoundMesh, RefusesWhatIsNoMesh) {
  expect_refused(mesh_of({0, 0, 0, 1, 0, 0}, {}), "without faces");
  expect_refused(mesh_of({0, 0, 0, 1, 0, 0}, {{0, 1, 1}}), "without faces");
  expect_refused(mesh_of({0, 0, 0}, {{0, 1, 2}}), "vertex");
  expect_refused(
      mesh_of({0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0}, {{0, 1, 2}}),
      "finite");
}

TEST(UnitBox, GoesThereAndBack) {
  Positions positions(2, 3);
  positions << 1e6, 2, 3, 1e6 + 3, 6, 3;
  const UnitBox box(positions);
  EXPECT_DOUBLE_EQ(box.diagonal(), 5);
  const Positions inside = box.to_box(positions);
  EXPECT_NEAR((inside.row(1) - inside.row(0)).norm(), 1, 1e-12);
  EXPECT_TRUE(box.from_box(inside).isApprox(positions));
}

}  // namespace
}  // namespace anicodec
