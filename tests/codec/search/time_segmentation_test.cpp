// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/time_segmentation.h"

#include "codec/encode.h"
#include "codec/file/clip_file.h"
#include "corpus/clips.h"
#include "sdk/clip/sample.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Waves, and after a hard cut other waves, turned about.
MeshSequence two_takes() {
  MeshSequence a = corpus::make_wave_grid(900, 70, 12);
  MeshSequence b = corpus::make_wave_grid(900, 70, 24);
  MeshSequence both = a;
  both.frame_count = 140;
  for (uint32_t f = 0; f < 70; ++f) {
    std::span<const float> frame = b.frame(f);
    for (size_t v = 0; v < 900; ++v) {
      const float* p = frame.data() + 3 * v;
      both.positions.insert(both.positions.end(), {p[1] + 3, p[2] - 2, p[0]});
    }
  }
  return both;
}

TEST(TimeSegmentation, SegmentsShareAPoseAndPlayInAnyOrder) {
  MeshSequence clip = two_takes();
  EncoderInput input(clip);
  LinearAnalysis analysis(input.frames());
  LinearSearch whole(input, analysis, BasisKind::kEigentrajectories, Effort::kFast, 1, true);
  double rmse = 0.0005 * diagonal(clip);
  std::optional<CodedSegment> one = whole.at_rmse(rmse);
  ASSERT_TRUE(one);
  TimeSegmentation segmentation(input, whole, one->encoded.reference, rmse);
  std::vector<CodedSegment> segments;
  for (uint32_t first : {0U, 70U}) {
    std::optional<CodedSegment> segment = segmentation.coded({first, 70});
    ASSERT_TRUE(segment);
    segment->encoded.sizes.first_frame = first;
    segments.push_back(std::move(*segment));
  }
  Clip opened;
  Bytes file = clip_file(ClipsRecord{}, input.layout, {&segments[0].encoded, &segments[1].encoded});
  ASSERT_TRUE(opened.open(file).ok());
  EXPECT_TRUE(opened.check_hashes().ok());
  ASSERT_EQ(opened.segments().size(), 2U);

  std::vector<float> a(2700), b(2700);
  double squared = 0;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    ASSERT_EQ(show_positions(opened, 0, f, a.data()), Status::kOk);
    for (size_t i = 0; i < a.size(); ++i)
      squared += std::pow(double{a[i]} - double{clip.frame(f)[i]}, 2);
  }
  EXPECT_LE(input.rmse(squared), rmse);
  ASSERT_EQ(show_positions(opened, 0, 139, b.data()), Status::kOk);
  EXPECT_EQ(a, b);
}

TEST(TimeSegmentation, LeavesOneMotionInOnePiece) {
  MeshSequence clip = corpus::make_clip("limb");
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, 0.1, false};
  options.effort = Effort::kFast;
  Clip opened;
  ASSERT_TRUE(opened.open(encode(clip, options).file).ok());
  EXPECT_EQ(opened.segments().size(), 1U);
}

}  // namespace
}  // namespace anicodec
