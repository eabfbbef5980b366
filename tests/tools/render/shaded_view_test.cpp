// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/shaded_view.h"

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(ShadedView, ShowsATriangleWhereItIs) {
  MeshSequence triangle;
  triangle.polygons.add(std::vector<uint32_t>{0, 1, 2});
  triangle.vertex_count = 3;
  const std::vector<float> positions = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  Box box;
  box.add(positions);
  ShadedView view(triangle, box, 65, 65);
  Camera front;
  front.azimuth = front.elevation = 0;
  const std::vector<float> red = {1, 0, 0, 1, 0, 0, 1, 0, 0};
  Image image = view.draw(positions, front, red);
  const uint8_t *centre = image.pixel(32, 32), *corner = image.pixel(2, 2);
  EXPECT_GT(centre[0], 100);
  EXPECT_LT(centre[1], 10);
  EXPECT_GT(corner[1], 200);
}

TEST(ShadedView, LeavesTheNotchOfAConcavePolygonOpen) {
  MeshSequence dart;
  dart.polygons.add(std::vector<uint32_t>{0, 1, 2, 3});
  dart.vertex_count = 4;
  const std::vector<float> positions = {-1, -1, 0, 0, 0.5F, 0, 1, -1, 0, 0, 1, 0};
  Box box;
  box.add(positions);
  ShadedView view(dart, box, 65, 65);
  Camera front;
  front.azimuth = front.elevation = 0;
  std::vector<float> red;
  for (int v = 0; v < 4; ++v)
    red.insert(red.end(), {1, 0, 0});
  Image image = view.draw(positions, front, red);
  EXPECT_GT(image.pixel(32, 40)[1], 100);  // below the inner corner
  EXPECT_LT(image.pixel(32, 16)[1], 10);
}

/// A roof of two squares that meet in an edge along z, seen from the front with that edge upright.
MeshSequence roof() {
  MeshSequence sequence;
  sequence.polygons.add(std::vector<uint32_t>{0, 1, 3, 2});
  sequence.polygons.add(std::vector<uint32_t>{1, 4, 5, 3});
  sequence.vertex_count = 6;
  return sequence;
}

TEST(ShadedView, ShadesHardEdgesFlat) {
  const std::vector<float> positions = {-1, -1, -1, 0, -1, 0,  -1, 1, -1,
                                        0,  1,  0,  1, -1, -1, 1,  1, -1};
  Box box;
  box.add(positions);
  Camera front;
  front.azimuth = front.elevation = 0;
  MeshSequence smooth = roof(), hard = roof();
  Attribute normals;
  normals.kind = AttributeKind::kNormal;
  normals.domain = AttributeDomain::kCorner;
  normals.components = 3;
  for (int c = 0; c < 8; ++c)
    normals.values.insert(normals.values.end(), {c < 4 ? -1.F : 1.F, 0, 1});
  hard.attributes.push_back(normals);
  const auto step_at_edge = [&](const MeshSequence& sequence) {
    Image image = ShadedView(sequence, box, 100, 100).draw(positions, front);
    return image.pixel(48, 50)[0] - image.pixel(51, 50)[0];
  };
  EXPECT_LT(std::abs(step_at_edge(smooth)), 10);
  EXPECT_GT(step_at_edge(hard), 25);
}

/// The nearer of two squares, one behind the other, is seen.
TEST(ShadedView, HidesWhatIsBehind) {
  MeshSequence sequence;
  sequence.polygons.add(std::vector<uint32_t>{0, 1, 2, 3});
  sequence.polygons.add(std::vector<uint32_t>{4, 5, 6, 7});
  sequence.vertex_count = 8;
  std::vector<float> positions, colours;
  for (float z : {1.F, -1.F}) {
    positions.insert(positions.end(), {-1, -1, z, 1, -1, z, 1, 1, z, -1, 1, z});
    for (int v = 0; v < 4; ++v)
      colours.insert(colours.end(), {z > 0 ? 1.F : 0, 0, z > 0 ? 0 : 1.F});
  }
  Box box;
  box.add(positions);
  Camera camera;
  camera.azimuth = camera.elevation = 0;
  ShadedView view(sequence, box, 64, 64);
  Image image = view.draw(positions, camera, colours);
  EXPECT_GT(image.pixel(32, 32)[0], image.pixel(32, 32)[2]);
  camera.azimuth = 180;
  image = view.draw(positions, camera, colours);
  EXPECT_LT(image.pixel(32, 32)[0], image.pixel(32, 32)[2]);
}

}  // namespace
}  // namespace anicodec::tools
