// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// docs/memory.md: an encoding holds no more than it may, and is refused only where it would come near that.
#include "codec/encode.h"
#include "codec/parallel/thread_count.h"
#include "codec/plan/encoding_memory.h"
#include "corpus/clips.h"
#include "tests/heap_count.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

// Nothing is refused that has so many times the memory that it takes, and two megabytes.
constexpr double kLoose = 4;
constexpr double kAny = 1 << 21;

EncodeOptions options_of(Effort effort, double kg = 0.1) {
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, kg, false};
  options.effort = effort;
  return options;
}

/// The most bytes that an encoding on one thread holds beside its source; none where it is refused.
std::optional<double> held(const MeshSequence& sequence, EncodeOptions options, double most_bytes) {
  options.most_bytes = static_cast<uint64_t>(most_bytes);
  std::optional<double> peak;
  with_threads(1, [&] {
    const HeapCount count;
    try {
      encode(sequence, options);
      peak = static_cast<double>(count.peak());
    } catch (const OverMemory&) {
    }
  });
  return peak;
}

void expect_within(const MeshSequence& sequence, const EncodeOptions& options) {
  const double free = held(sequence, options, 0).value();
  for (const double share : {0.4, 0.8, 1.2, 2.0}) {
    const std::optional<double> peak = held(sequence, options, share * free);
    EXPECT_LE(peak.value_or(0), share * free);
  }
  EXPECT_TRUE(held(sequence, options, kLoose * free + kAny)) << free;
}

TEST(EncoderMemory, OfManyFramesOfFewVertices) {
  expect_within(corpus::make_wave_grid(100, 500, 5), options_of(Effort::kFast));
  expect_within(corpus::make_wave_grid(100, 500, 5), options_of(Effort::kNormal));
}

TEST(EncoderMemory, OfLongClips) {
  expect_within(corpus::make_wave_grid(100, 2000, 5), options_of(Effort::kFast));
  expect_within(corpus::make_scaled("noisy", 100, 520), options_of(Effort::kFast, 1));
  expect_within(corpus::make_scaled("limb", 600, 600), options_of(Effort::kFast));
}

TEST(EncoderMemory, OfLongClipsGrowsWithTheirFrames) {
  const double few =
      held(corpus::make_wave_grid(600, 800, 5), options_of(Effort::kFast), 0).value();
  const double many =
      held(corpus::make_wave_grid(600, 1600, 5), options_of(Effort::kFast), 0).value();
  EXPECT_LT(many, 2.2 * few);
}

TEST(EncoderMemory, OfManyVerticesInFewFrames) {
  expect_within(corpus::make_wave_grid(8000, 3, 2), options_of(Effort::kFast));
  expect_within(corpus::make_scaled("limb", 4000, 3), options_of(Effort::kNormal));
  expect_within(corpus::make_scaled("soup", 1000, 10), options_of(Effort::kNormal));
  expect_within(corpus::make_scaled("points", 2000, 10), options_of(Effort::kNormal));
}

TEST(EncoderMemory, OfManyComponents) {
  expect_within(corpus::make_wave_grid(1000, 120, 60), options_of(Effort::kFast, 0.01));
  expect_within(corpus::make_wave_grid(1700, 60, 40), options_of(Effort::kNormal, 0.01));
  expect_within(corpus::make_scaled("noisy", 300, 60), options_of(Effort::kNormal, 0.05));
}

TEST(EncoderMemory, RegionsAreNotTriedWhereItIsShort) {
  const MeshSequence sequence = corpus::make_wave_grid(1700, 60, 40);
  EncodeOptions options = options_of(Effort::kNormal, 0.01);
  options.basis = BasisChoice::kEigentrajectories;
  const EncodingMemory memory = EncodingMemory::of(sequence, options);
  constexpr double kFirstComponents = 48;
  const double bases =
      2 * memory.basis(BasisKind::kEigentrajectories, kFirstComponents, options.effort);
  const double most = memory.kept(options) + memory.thread(options) + bases;
  const std::optional<double> peak = held(sequence, options, most);
  ASSERT_TRUE(peak);
  EXPECT_LE(*peak, most);
}

TEST(EncoderMemory, OfKeyframesAndOfExactPositions) {
  EncodeOptions options = options_of(Effort::kNormal);
  options.basis = BasisChoice::kKeyframes;
  expect_within(corpus::make_scaled("limb", 500, 200), options);
  options = options_of(Effort::kFast);
  options.target = {ErrorMetric::kMaxError, 0, false};
  expect_within(corpus::make_scaled("limb", 2000, 30), options);
}

/// Every frame another place for each vertex, far from all others.
MeshSequence noise(uint32_t vertices, uint32_t frames) {
  MeshSequence sequence = corpus::make_wave_grid(vertices, frames, 4);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> anywhere(0, 1);
  std::ranges::generate(sequence.positions, [&] { return anywhere(random); });
  return sequence;
}

TEST(EncoderMemory, OfFineKeyframesByDraco) {
  const MeshSequence sequence = noise(60, 40);
  EncodeOptions options;
  options.basis = BasisChoice::kKeyframes;
  options.keyframe_poses = KeyframePoses::kDraco;
  for (const double error : {1e-3, 1e-5, 1e-6}) {
    options.target = {ErrorMetric::kMaxError, error, false};
    expect_within(sequence, options);
  }
  EXPECT_LT(held(sequence, options, 0).value(), 64 << 20);
}

TEST(EncoderMemory, OfAttributes) {
  MeshSequence sequence = corpus::make_wave_grid(1000, 60, 5);
  Attribute& heat = sequence.attributes.emplace_back();
  heat.kind = AttributeKind::kCustom;
  heat.name = "heat";
  heat.components = 3;
  heat.frames = sequence.frame_count;
  for (const float x : sequence.positions)
    heat.values.push_back(x * x);
  expect_within(sequence, options_of(Effort::kNormal));
  Attribute uv;
  uv.domain = AttributeDomain::kCorner;
  for (const uint32_t corner : sequence.polygons.corners) {
    for (uint32_t axis = 0; axis < 2; ++axis)
      uv.values.push_back(sequence.positions[size_t{3} * corner + axis]);
  }
  sequence.attributes.clear();
  for (int i = 0; i < 8; ++i) {
    uv.name = "uv" + std::to_string(i);
    sequence.attributes.push_back(uv);
  }
  expect_within(sequence, options_of(Effort::kNormal));
}

/// So many times the same mesh.
Scene scene_of_grids(int meshes, uint32_t vertices, uint32_t frames) {
  Scene scene;
  scene.clip = corpus::make_wave_grid(vertices, frames, 4);
  for (int m = 0; m < meshes; ++m) {
    SceneMesh& mesh = scene.meshes.emplace_back();
    mesh.sequence = scene.clip;
    mesh.sequence.mesh_name = "mesh" + std::to_string(m);
    mesh.present_in = {{0, frames}};
  }
  scene.clip.positions.clear();
  return scene;
}

TEST(EncoderMemory, OfASceneIsThatOfItsMeshes) {
  const Scene scene = scene_of_grids(4, 400, 100);
  EncodeOptions options = options_of(Effort::kFast);
  options.most_bytes = 5'000'000;
  EXPECT_THROW(encode(scene, options), OverMemory);
  options.most_bytes = 12'000'000;
  const HeapCount count;
  with_threads(1, [&] { encode(scene, options); });
  EXPECT_LE(count.peak(), options.most_bytes);
}

TEST(EncoderMemory, OfSmallMeshesTogetherIsWithinWhatTheyMayHold) {
  const Scene scene = scene_of_grids(30, 100, 20);
  EncodeOptions options = options_of(Effort::kFast);
  options.most_bytes = 4 * (36 << 20);
  const HeapCount count;
  with_threads(4, [&] { encode(scene, options); });
  EXPECT_LE(count.peak(), options.most_bytes);
}

TEST(EncoderMemory, TakesFewerThreadsWhereItIsShort) {
  EncodingMemory memory;
  memory.vertices = 100000;
  memory.frames = 10;
  EncodeOptions options = options_of(Effort::kNormal);
  const double kept = memory.kept(options), thread = memory.thread(options);
  for (const auto& [times, threads] : {std::pair(1.0, 1U), {4.5, 2U}, {5.5, 3U}, {40.0, 8U}}) {
    options.most_bytes = static_cast<uint64_t>(kept + times * thread + 1);
    EXPECT_EQ(plan_memory(memory, options, 8).threads, threads);
  }
  options.most_bytes = static_cast<uint64_t>(kept + thread - 1);
  EXPECT_THROW(plan_memory(memory, options, 8), OverMemory);
}

}  // namespace
}  // namespace anicodec
