// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage_choice.h"

#include "codec/encode.h"
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

EncodeOptions massaged_at_kg(double kg, MassageMode mode) {
  EncodeOptions options = at_kg(kg);
  options.massage.mode = mode;
  return options;
}

ClipRecord record_of(const EncodeResult& result) {
  Clip clip;
  EXPECT_TRUE(clip.open(result.file).ok());
  return clip.clips()[0];
}

TEST(MassageChoice, RecordsThatAndHowFarTheSurfaceMoved) {
  const EncodeResult result =
      encode(corpus::make_scaled("sliding", 400, 8), massaged_at_kg(0.1, MassageMode::kOn));
  const MassageVerdict& verdict = result.massage;
  ASSERT_TRUE(verdict.change);
  const ClipRecord record = record_of(result);
  EXPECT_TRUE(record.massaged);
  EXPECT_EQ(record.surface_error, verdict.change->max);
  EXPECT_EQ(record.surface_error_mean, verdict.change->mean);
  EXPECT_GT(record.surface_error_mean, 0);
  EXPECT_LT(record.surface_error_mean, record.surface_error);
}

TEST(SlowMassageChoice, AutoTakesASlidingClip) {
  const MeshSequence clip = corpus::make_scaled("sliding", 400, 16);
  const EncodeResult result = encode(clip, massaged_at_kg(0.1, MassageMode::kAuto));
  const MassageVerdict& verdict = result.massage;
  EXPECT_TRUE(verdict.change);
  EXPECT_LT(verdict.sample_massaged_bytes, verdict.sample_plain_bytes);
  EXPECT_LT(result.file.size(), encode(clip, at_kg(0.1)).file.size());
}

TEST(MassageChoice, AutoLeavesACleanClipByteForByte) {
  for (const char* name : {"limb", "waves"}) {
    const MeshSequence clip = corpus::make_scaled(name, 300, 12);
    const EncodeResult result = encode(clip, massaged_at_kg(0.1, MassageMode::kAuto));
    EXPECT_FALSE(result.massage.change) << name;
    EXPECT_EQ(result.file, encode(clip, at_kg(0.1)).file) << name;
    EXPECT_FALSE(record_of(result).massaged);
  }
}

TEST(MassageChoice, AutoCodesWhatHasNoSurface) {
  const MeshSequence points = corpus::make_clip("points");
  EXPECT_FALSE(encode(points, massaged_at_kg(0.1, MassageMode::kAuto)).massage.change);
  EXPECT_THROW(encode(points, massaged_at_kg(0.1, MassageMode::kOn)), Error);
}

TEST(MassageChoice, NeedsASequenceThatFits) {
  MeshSequence clip = corpus::make_scaled("limb", 300, 12);
  clip.positions.resize(clip.positions.size() / 2);
  EXPECT_THROW(encode(clip, massaged_at_kg(0.1, MassageMode::kAuto)), Error);
}

TEST(MassageChoice, KeepsTheSurfaceWithinTheTolerance) {
  const MeshSequence clip = corpus::make_scaled("sliding", 400, 8);
  EncodeOptions options = massaged_at_kg(0.1, MassageMode::kOn);
  options.massage.options.tolerance = 0.002 * diagonal(clip);
  const MassageVerdict verdict = encode(clip, options).massage;
  ASSERT_TRUE(verdict.change);
  EXPECT_LT(verdict.change->max, 1.001 * options.massage.options.tolerance);
}

}  // namespace
}  // namespace anicodec
