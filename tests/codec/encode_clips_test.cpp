// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Several clips in one file: a small one beside a large one, each with a percentage of its own diagonal.
#include "codec/encode.h"
#include "corpus/clips.h"
#include "sdk/clip/clip.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr uint32_t kFrames = 16;

/// A limb that swings, and after it the same limb, `factor` times as large as at first.
MeshSequence small_and_large(float factor) {
  MeshSequence clip = corpus::make_scaled("limb", 200, 2 * kFrames);
  for (size_t i = 0; i < clip.positions.size(); ++i) {
    if (i >= clip.positions.size() / 2)
      clip.positions[i] *= factor;
  }
  for (const char* name : {"small", "large"}) {
    ClipTiming& timing = clip.clips.emplace_back();
    timing.name = name;
    timing.frame_count = kFrames;
  }
  return clip;
}

struct Asked {
  const char* name;
  Target target;
  BasisChoice basis = BasisChoice::kAuto;
};

double measured(const ClipRecord& clip, ErrorMetric metric) {
  switch (metric) {
    case ErrorMetric::kRmse:
      return clip.rmse;
    case ErrorMetric::kDisplacement:
      return clip.max_displacement_error;
    default:
      return clip.max_error;
  }
}

class PercentOfClips : public testing::TestWithParam<Asked> {};

TEST_P(PercentOfClips, IsOfTheDiagonalOfEach) {
  const MeshSequence source = small_and_large(100);
  const std::vector<double> diagonals = clip_diagonals(source);
  ASSERT_GT(diagonals[1], 50 * diagonals[0]);
  EncodeOptions options;
  options.target = GetParam().target;
  options.basis = GetParam().basis;
  options.effort = Effort::kFast;
  const EncodeResult result = encode(source, options);
  Clip file;
  ASSERT_TRUE(file.open(result.file).ok());
  for (size_t c = 0; c < 2; ++c) {
    const ClipRecord& clip = file.clips()[c];
    const double bound = options.target.value / 100 * diagonals[c];
    EXPECT_EQ(clip.diagonal, diagonals[c]);
    EXPECT_DOUBLE_EQ(clip.asked_value, bound);
    EXPECT_EQ(clip.asked, options.target.metric);
    EXPECT_LE(measured(clip, clip.asked), bound) << c;
    // Neither pays for the other.
    EXPECT_GT(measured(clip, clip.asked), 0.1 * bound) << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, PercentOfClips,
                         testing::Values(Asked{"MaxError", {ErrorMetric::kMaxError, 0.5, true}},
                                         Asked{"Rmse", {ErrorMetric::kRmse, 0.1, true}},
                                         Asked{"Displacement",
                                               {ErrorMetric::kDisplacement, 0.2, true}},
                                         Asked{"MaxErrorOfKeyframes",
                                               {ErrorMetric::kMaxError, 0.5, true},
                                               BasisChoice::kKeyframes}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(EncodeClips, ACapInPerCentIsOfEachClip) {
  const MeshSequence source = small_and_large(20);
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 5, false};
  options.cap = {ErrorMetric::kMaxError, 0.3, true};
  options.effort = Effort::kFast;
  const EncodeResult result = encode(source, options);
  for (const ClipResult& clip : result.clips) {
    EXPECT_LE(clip.max_error, 0.003 * clip.diagonal) << clip.name;
    EXPECT_LE(clip.kg, 5) << clip.name;
  }
}

TEST(EncodeClips, ClipsThatAreAllPointsTakeTheBoundOfTheWhole) {
  MeshSequence source;
  source.vertex_count = 1;
  source.frame_count = 3;
  source.positions = {-1494.75F, 17486.25F, 1900,    -1494.75F, 8002.5F,
                      1900,      -1494.75F, 8002.5F, 1900};
  for (const uint32_t frames : {1U, 2U}) {
    ClipTiming& clip = source.clips.emplace_back();
    clip.name = std::to_string(frames);
    clip.frame_count = frames;
  }
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.5, true};
  const EncodeResult result = encode(source, options);
  for (const ClipResult& clip : result.clips)
    EXPECT_LE(clip.max_error, 0.005 * diagonal(source)) << clip.name;
}

TEST(EncodeClips, ALengthInSceneUnitsIsTheSameForAll) {
  const MeshSequence source = small_and_large(20);
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.02, false};
  options.effort = Effort::kFast;
  Clip file;
  ASSERT_TRUE(file.open(encode(source, options).file).ok());
  for (const ClipRecord& clip : file.clips())
    EXPECT_EQ(clip.asked_value, 0.02);
}

TEST(EncodeClips, AClipThatIsAPointTakesTheBoundOfTheSmallestOther) {
  const MeshSequence source = small_and_large(0);
  const double diagonal = clip_diagonals(source)[0];
  for (const ErrorMetric metric : {ErrorMetric::kMaxError, ErrorMetric::kRmse}) {
    EncodeOptions options;
    options.target = {metric, 0.1, true};
    options.effort = Effort::kFast;
    Clip file;
    ASSERT_TRUE(file.open(encode(source, options).file).ok());
    EXPECT_DOUBLE_EQ(file.clips()[1].asked_value, 0.001 * diagonal);
    EXPECT_LE(measured(file.clips()[1], metric), 0.001 * diagonal);
  }
}

}  // namespace
}  // namespace anicodec
