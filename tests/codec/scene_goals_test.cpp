// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/scene_goals.h"

#include "codec/encode.h"
#include "codec/sequence/error.h"
#include "codec/sequence/scene.h"
#include "format/container.h"
#include "sdk/clip/sample.h"
#include "tests/two_boxes.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::HasSubstr;

TEST(SceneGoals, KeepsTheErrorOfTheWholeAndTheRunsOfEach) {
  const MeshSequence whole = two_boxes();
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 0.1, false};
  const EncodeResult result = encode(split_parts(whole), options);
  EXPECT_LE(result.kg, 0.1);
  EXPECT_EQ(result.vertices, whole.vertex_count);
  Clip clip;
  ASSERT_TRUE(clip.open(result.file).ok());
  ASSERT_EQ(clip.meshes().size(), 2U);
  EXPECT_EQ(clip.meshes()[0].name, "turning");
  // A box that only turns and moves is a key-frame with a rigid motion, or a pose with an affine one.
  const Limits::Segment& box = clip.limits().segments[0];
  EXPECT_EQ(box.components, box.kind == BasisKind::kKeyframes ? 1U : 0U);
  std::vector<float> positions(size_t{3} * whole.vertex_count);
  double worst = 0;
  for (uint32_t f = 0; f < kBoxFrames; ++f) {
    size_t first = 0;
    for (uint32_t m = 0; m < 2; ++m) {
      const size_t count = size_t{3} * clip.vertex_count(m);
      const bool hidden = m == 1 && f >= 4 && f < 8;
      EXPECT_EQ(show_positions(clip, m, f, positions.data()),
                hidden ? Status::kAbsent : Status::kOk);
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

TEST(SceneGoals, KeepsTheMetadataOnce) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  options.metadata = R"({"author":"A"})";
  const EncodeResult result = encode(split_parts(two_boxes()), options);
  ContainerReader reader;
  ASSERT_TRUE(reader.open(result.file).ok());
  ByteView text;
  ASSERT_TRUE(reader.payload(*reader.find("META"), &text).ok());
  EXPECT_EQ(std::string(text.data, text.data + text.size), options.metadata);
}

TEST(SceneGoals, NamesTheMeshThatFails) {
  Scene scene = split_parts(two_boxes());
  scene.meshes[1].sequence.positions[5] = NAN;
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.1, true};
  try {
    encode(std::move(scene), options);
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("mesh 'still': "));
  }
}

TEST(SceneGoals, TakesAllFramesOfAMeshThatHasFewerThanKeyframes) {
  Scene scene = split_parts(two_boxes());
  MeshSequence& brief = scene.meshes[1].sequence;
  brief.frame_count = 3;
  brief.positions.resize(size_t{9} * brief.vertex_count);
  scene.meshes[1].present_in = {{2, 3}};
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.keyframes = 5;
  for (const KeyframeMethod method :
       {KeyframeMethod::kGas, KeyframeMethod::kPivot, KeyframeMethod::kUniform}) {
    options.select = method;
    Clip clip;
    ASSERT_TRUE(clip.open(encode(scene, options).file).ok());
    EXPECT_LE(clip.limits().segments[1].components, 3U);
    EXPECT_THROW(encode(scene.meshes[1].sequence, options), Error);
  }
}

TEST(SceneGoals, AreThoseOfTheWhole) {
  const Scene scene = split_parts(two_boxes());
  const SceneExtent extent = extent_of(scene);
  EXPECT_NEAR(extent.diagonal, diagonal(two_boxes()), 1e-6);
  EXPECT_EQ(shared_goal({ErrorMetric::kMaxError, 1, true}, {}, extent).bound.value,
            extent.diagonal / 100);
  const Bound of_kg = shared_goal({ErrorMetric::kKg, 0.1, false}, {}, extent).bound;
  EXPECT_EQ(of_kg.metric, ErrorMetric::kRmse);
  EXPECT_DOUBLE_EQ(of_kg.value, 0.001 * std::sqrt(extent.spread / extent.positions));
}

TEST(SceneGoals, RefusesScenesWithoutMeshAndMeshesWithoutFrame) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  Scene scene = split_parts(two_boxes());
  scene.meshes[1].present_in.clear();
  EXPECT_THROW(encode(scene, options), Error);
  scene.meshes.clear();
  EXPECT_THROW(encode(scene, options), Error);
}

TEST(SceneGoals, RefusesATargetSize) {
  EncodeOptions options;
  options.target = {ErrorMetric::kSize, 1e6, false};
  EXPECT_THROW(encode(split_parts(two_boxes()), options), Error);
}

}  // namespace
}  // namespace anicodec
