// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/opening_time.h"

#include "codec/encode.h"
#include "corpus/clips.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(OpeningTime, FallsWithCheaperSettings) {
  EncodedSegment encoded;
  encoded.sizes.kind = BasisKind::kEigentrajectories;
  encoded.sizes.components = 40;
  encoded.coefficient_bytes = 10000;
  const auto time = [&](const auto& change) {
    LinearSettings settings;
    change(settings);
    return opening_nanoseconds(settings, encoded, 7000);
  };
  const double usual = time([](LinearSettings&) {});
  EXPECT_LT(time([](LinearSettings& s) { s.neighbours = 8; }), usual);
  EXPECT_LT(time([](LinearSettings& s) { s.schedule = RefitSchedule::kSparse; }), usual);
  EXPECT_LT(time([](LinearSettings& s) { s.schedule = RefitSchedule::kNone; }),
            time([](LinearSettings& s) { s.schedule = RefitSchedule::kSparse; }));
  EXPECT_GT(time([](LinearSettings& s) { s.alike = 8; }), usual);
}

TEST(OpeningTime, IsWorthNothingToTheSmallestFile) {
  EXPECT_EQ(bytes_per_nanosecond(true), 0);
  EXPECT_GT(bytes_per_nanosecond(false), 0);
}

TEST(OpeningTime, PaysInBytes) {
  const MeshSequence clip = corpus::make_scaled("limb", 3000, 30);
  const auto bytes = [&](bool smallest) {
    EncodeOptions options;
    options.target = {ErrorMetric::kKg, 0.2, false};
    options.basis = BasisChoice::kEigentrajectories;
    options.effort = Effort::kNormal;
    options.smallest = smallest;
    const EncodeResult result = encode(clip, options);
    EXPECT_LE(result.kg, 0.2);
    return static_cast<double>(result.file.size());
  };
  const double smallest = bytes(true), balanced = bytes(false);
  EXPECT_LE(smallest, balanced * 1.01);
  EXPECT_LT(balanced, smallest * 1.1);
}

}  // namespace
}  // namespace anicodec
