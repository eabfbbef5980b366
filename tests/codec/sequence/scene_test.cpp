// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/scene.h"

#include "codec/encode_scene.h"
#include "codec/sequence/error.h"
#include "sdk/clip/clip.h"
#include "tests/two_boxes.h"

#include <cmath>
#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::HasSubstr;

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

TEST(EncodeScene, KeepsTheErrorOfTheWholeAndTheRunsOfEach) {
  const MeshSequence whole = two_boxes();
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 0.1, false};
  const EncodeResult result = encode_scene(split_parts(whole), options);
  EXPECT_LE(result.kg, 0.1);
  EXPECT_EQ(result.vertices, whole.vertex_count);
  Clip clip;
  ASSERT_TRUE(clip.open(result.file).ok());
  ASSERT_EQ(clip.meshes().size(), 2U);
  EXPECT_EQ(clip.meshes()[0].name, "turning");
  // A box that only turns and moves is a key-frame with a rigid motion.
  EXPECT_EQ(clip.limits().segments[0].kind, BasisKind::kKeyframes);
  EXPECT_EQ(clip.limits().segments[0].components, 1U);
  std::vector<float> positions(size_t{3} * whole.vertex_count);
  double worst = 0;
  for (uint32_t f = 0; f < kBoxFrames; ++f) {
    size_t first = 0;
    for (uint32_t m = 0; m < 2; ++m) {
      const size_t count = size_t{3} * clip.vertex_count(m);
      const bool hidden = m == 1 && f >= 4 && f < 8;
      EXPECT_EQ(clip.positions(m, f, positions.data()), hidden ? Status::kAbsent : Status::kOk);
      for (size_t i = 0; i < count && !hidden; i += 3)
        worst =
            std::max(worst, std::hypot(double{positions[i]} - whole.frame(f)[first + i],
                                       double{positions[i + 1]} - whole.frame(f)[first + i + 1],
                                       double{positions[i + 2]} - whole.frame(f)[first + i + 2]));
      first += count;
    }
  }
  EXPECT_LE(worst, result.max_error * 1.0001);
}

TEST(EncodeScene, NamesTheMeshThatFails) {
  Scene scene = split_parts(two_boxes());
  scene.meshes[1].sequence.positions[5] = NAN;
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.1, true};
  try {
    encode_scene(std::move(scene), options);
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("mesh 'still': "));
  }
}

TEST(EncodeScene, RefusesATargetSize) {
  EncodeOptions options;
  options.target = {ErrorMetric::kSize, 1e6, false};
  EXPECT_THROW(encode_scene(split_parts(two_boxes()), options), Error);
}

}  // namespace
}  // namespace anicodec
