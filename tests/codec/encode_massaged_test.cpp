// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_massaged.h"

#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "sdk/clip/clip.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

EncodeOptions at_kg(double kg) {
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, kg, false};
  options.effort = Effort::kFast;
  return options;
}

ClipRecord record_of(const EncodeResult& result) {
  Clip clip;
  EXPECT_TRUE(clip.open(result.file).ok());
  return clip.clips()[0];
}

TEST(EncodeMassaged, RecordsThatAndHowFarTheSurfaceMoved) {
  MassageVerdict verdict;
  const EncodeResult result = encode_massaged(corpus::make_scaled("sliding", 400, 8),
                                              MassageMode::kOn, {}, at_kg(0.1), &verdict);
  ASSERT_TRUE(verdict.change);
  const ClipRecord record = record_of(result);
  EXPECT_TRUE(record.massaged);
  EXPECT_EQ(record.surface_error, verdict.change->max);
  EXPECT_EQ(record.surface_error_mean, verdict.change->mean);
  EXPECT_GT(record.surface_error_mean, 0);
  EXPECT_LT(record.surface_error_mean, record.surface_error);
}

TEST(SlowEncodeMassaged, AutoTakesASlidingClip) {
  const MeshSequence clip = corpus::make_scaled("sliding", 400, 16);
  MassageVerdict verdict;
  const EncodeResult result = encode_massaged(clip, MassageMode::kAuto, {}, at_kg(0.1), &verdict);
  EXPECT_TRUE(verdict.change);
  EXPECT_LT(verdict.sample_massaged_bytes, verdict.sample_plain_bytes);
  EXPECT_LT(result.file.size(), encode(clip, at_kg(0.1)).file.size());
}

TEST(EncodeMassaged, AutoLeavesACleanClipByteForByte) {
  for (const char* name : {"limb", "waves"}) {
    const MeshSequence clip = corpus::make_scaled(name, 300, 12);
    MassageVerdict verdict;
    const EncodeResult result = encode_massaged(clip, MassageMode::kAuto, {}, at_kg(0.1), &verdict);
    EXPECT_FALSE(verdict.change) << name;
    EXPECT_EQ(result.file, encode(clip, at_kg(0.1)).file) << name;
    EXPECT_FALSE(record_of(result).massaged);
  }
}

TEST(EncodeMassaged, AutoCodesWhatHasNoSurface) {
  MassageVerdict verdict;
  encode_massaged(corpus::make_clip("points"), MassageMode::kAuto, {}, at_kg(0.1), &verdict);
  EXPECT_FALSE(verdict.change);
  EXPECT_THROW(
      encode_massaged(corpus::make_clip("points"), MassageMode::kOn, {}, at_kg(0.1), &verdict),
      Error);
}

TEST(EncodeMassaged, KeepsTheSurfaceWithinTheTolerance) {
  const MeshSequence clip = corpus::make_scaled("sliding", 400, 8);
  MassageOptions options;
  options.tolerance = 0.002 * diagonal(clip);
  MassageVerdict verdict;
  encode_massaged(clip, MassageMode::kOn, options, at_kg(0.1), &verdict);
  ASSERT_TRUE(verdict.change);
  EXPECT_LT(verdict.change->max, 1.001 * options.tolerance);
}

}  // namespace
}  // namespace anicodec
