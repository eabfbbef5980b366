// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/scene.h"

#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "sdk/clip/clip.h"
#include "tests/two_boxes.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(Scene, IsASequenceTakenApart) {
  const MeshSequence whole = two_boxes();
  const Scene scene = split_parts(whole);
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.clip.frame_count, kBoxFrames);
  EXPECT_EQ(scene.meshes[0].sequence.mesh_name, "turning");
  EXPECT_EQ(scene.meshes[1].sequence.mesh_name, "still");
  EXPECT_EQ(scene.meshes[0].present_in, (std::vector<FrameRun>{{0, kBoxFrames}}));
  EXPECT_EQ(scene.meshes[1].present_in, (std::vector<FrameRun>{{0, 4}, {8, 4}}));
  EXPECT_EQ(scene.meshes[1].sequence.frame_count, 8U);
  const uint32_t half = whole.vertex_count / 2;
  for (uint32_t v = 0; v < half; ++v)
    EXPECT_EQ(scene.meshes[1].sequence.frame(4)[3 * v], whole.frame(8)[3 * (half + v)]);

  std::vector<MeshSequence> meshes{scene.meshes[0].sequence, scene.meshes[1].sequence};
  const MeshSequence merged = merge_meshes(meshes);
  EXPECT_EQ(merged.polygons, whole.polygons);
  EXPECT_EQ(merged.parts, whole.parts);
  EXPECT_EQ(merged.vertex_count, whole.vertex_count);
  auto material = [](const MeshSequence& mesh, size_t p) {
    const uint32_t label = mesh.materials.of_polygon[p];
    return label == kNoLabel ? "none" : mesh.materials.names[label];
  };
  ASSERT_EQ(merged.materials.of_polygon.size(), whole.polygons.size());
  for (size_t p = 0; p < whole.polygons.size(); ++p)
    EXPECT_EQ(material(merged, p), material(whole, p));
}

TEST(Scene, IsClosedWhereItEndsAsItBegins) {
  MeshSequence whole = two_boxes();
  EXPECT_FALSE(is_closed(split_parts(whole)));
  std::ranges::copy(whole.frame(0), whole.frame(kBoxFrames - 1).begin());
  const Scene scene = split_parts(whole);
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_TRUE(is_closed(scene));
  EXPECT_TRUE(is_closed(scene_of(whole)));
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  Clip clip;
  ASSERT_TRUE(clip.open(encode(scene, options).file).ok());
  EXPECT_TRUE(clip.clips()[0].closed);

  Scene leaves = scene;
  leaves.meshes[1].present_in.back().count -= 1;
  EXPECT_FALSE(is_closed(leaves));
}

TEST(Scene, WithoutPartsIsOneMesh) {
  MeshSequence whole = two_boxes();
  whole.parts = {};
  const Scene scene = split_parts(whole);
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.meshes[0].sequence.positions, whole.positions);
  EXPECT_EQ(scene.meshes[0].present_in, (std::vector<FrameRun>{{0, kBoxFrames}}));
}

TEST(Scene, SharedAndUnusedVerticesGoWithTheirParts) {
  MeshSequence whole;
  whole.frame_count = 1;
  whole.vertex_count = 6;
  for (const auto& triangle : {std::vector<uint32_t>{0, 1, 2}, {2, 4, 5}})
    whole.polygons.add(triangle);  // 2 is of both, 3 of none
  whole.parts = {{"a", "b"}, {0, 1}};
  for (int i = 0; i < 18; ++i)
    whole.positions.push_back(static_cast<float>(i * i));
  const Scene scene = split_parts(whole);
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.meshes[0].sequence.vertex_count + scene.meshes[1].sequence.vertex_count, 7U);
  EXPECT_EQ(scene.meshes[1].sequence.positions[0], whole.positions[6]);
}

TEST(Scene, PolygonsWithoutCornersStayWithThoseBefore) {
  MeshSequence whole = two_boxes();
  const size_t polygons = whole.polygons.size();
  whole.polygons.add({});
  whole.parts.names.push_back("nothing");
  whole.parts.of_polygon.push_back(2);
  whole.materials = {};
  const Scene scene = split_parts(whole);
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.meshes[1].sequence.polygons.size(), polygons / 2 + 1);
}

TEST(Scene, ThatIsNoSequenceIsRefused) {
  MeshSequence whole = two_boxes();
  whole.polygons.corners[3] = whole.vertex_count;
  EXPECT_THROW(split_parts(whole), Error);
  EXPECT_THROW(split_parts({}), Error);
}

}  // namespace
}  // namespace anicodec
