// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_scene.h"

#include "codec/encode.h"
#include "codec/parallel/thread_count.h"
#include "codec/sequence/error.h"
#include "codec/sequence/scene.h"
#include "corpus/clips.h"
#include "format/container.h"
#include "sdk/clip/sample.h"
#include "tests/two_boxes.h"

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::HasSubstr;

TEST(EncodeScene, KeepsTheErrorOfTheWholeAndTheRunsOfEach) {
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

TEST(EncodeScene, KeepsTheMetadataOnce) {
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

TEST(EncodeScene, NamesTheMeshThatFails) {
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

TEST(EncodeScene, TakesAllFramesOfAMeshThatHasFewerThanKeyframes) {
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

TEST(EncodeScene, RefusesScenesWithoutMeshAndMeshesWithoutFrame) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1, true};
  Scene scene = split_parts(two_boxes());
  scene.meshes[1].present_in.clear();
  EXPECT_THROW(encode(scene, options), Error);
  scene.meshes.clear();
  EXPECT_THROW(encode(scene, options), Error);
}

TEST(EncodeScene, RefusesATargetSize) {
  EncodeOptions options;
  options.target = {ErrorMetric::kSize, 1e6, false};
  EXPECT_THROW(encode(split_parts(two_boxes()), options), Error);
}

constexpr uint32_t kSceneFrames = 6;

/// Boxes that move, of which every third turns; one is so large that it is encoded by itself.
Scene many_meshes() {
  constexpr int kMeshes = 20, kLarge = 13;
  Scene scene;
  scene.clip.frame_count = kSceneFrames;
  for (int m = 0; m < kMeshes; ++m) {
    SceneMesh& mesh = scene.meshes.emplace_back();
    mesh.present_in = {{0, kSceneFrames}};
    mesh.sequence = m == kLarge ? corpus::make_wave_grid(3000, kSceneFrames, 4)
                                : corpus::make_clip("painted_box");
    MeshSequence& sequence = mesh.sequence;
    sequence.mesh_name = "mesh" + std::to_string(m);
    if (m == kLarge)
      continue;
    const std::vector<float> box(sequence.positions.begin(),
                                 sequence.positions.begin() + size_t{3} * sequence.vertex_count);
    sequence.frame_count = kSceneFrames;
    sequence.attributes.clear();
    sequence.positions.clear();
    for (uint32_t f = 0; f < kSceneFrames; ++f) {
      const float t = 0.2F * static_cast<float>(f) * static_cast<float>(m);
      const float c = m % 3 == 0 ? std::cos(t) : 1, s = m % 3 == 0 ? std::sin(t) : 0;
      for (size_t i = 0; i < box.size(); i += 3)
        sequence.positions.insert(
            sequence.positions.end(),
            {c * box[i] - s * box[i + 1] + t, s * box[i] + c * box[i + 1], box[i + 2]});
    }
  }
  return scene;
}

EncodeOptions usual_target() {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.05, true};
  return options;
}

TEST(EncodeScene, IsTheSameForAnyNumberOfThreadsAndWithLittleMemory) {
  const Scene scene = many_meshes();
  EncodeOptions options = usual_target();
  Bytes by_one, by_four, one_by_one;
  with_threads(1, [&] { by_one = encode(scene, options).file; });
  with_threads(4, [&] { by_four = encode(scene, options).file; });
  EXPECT_EQ(by_four, by_one);
  options.most_bytes = 100'000'000;  // too little for four meshes at a time
  with_threads(4, [&] { one_by_one = encode(scene, options).file; });
  EXPECT_EQ(one_by_one, by_one);
}

TEST(EncodeScene, ThrowsTheErrorOfTheFirstMeshThatHasOne) {
  Scene scene = many_meshes();
  for (const size_t m : {4, 9}) {
    for (float& x : scene.meshes[m].sequence.positions)
      x *= 1e6F;
  }
  EncodeOptions options = usual_target();
  options.target = {ErrorMetric::kMaxError, 1e-3, false};
  for (int round = 0; round < 5; ++round) {
    with_threads(4, [&] {
      try {
        encode(scene, options);
        ADD_FAILURE();
      } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("mesh 'mesh4': "));
      }
    });
  }
}

TEST(EncodeScene, TellsItsProgressAndLeavesWhenThatThrows) {
  struct Left {};

  double last = 0;
  encode(many_meshes(), usual_target(), [&](std::string_view, double done) {
    EXPECT_LE(last, done);
    EXPECT_LE(done, 1);
    last = done;
  });
  EXPECT_GT(last, 0.5);
  EXPECT_THROW(
      encode(many_meshes(), usual_target(), [](std::string_view, double) { throw Left(); }), Left);
}

}  // namespace
}  // namespace anicodec
