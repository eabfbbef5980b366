// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/moving_attributes.h"

#include "codec/encode.h"
#include "codec/file/join_clips.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/container.h"
#include "sdk/clip/clip.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

EncodeOptions coarse(BasisChoice basis = BasisChoice::kEigentrajectories) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 0.5, true};
  options.basis = basis;
  options.effort = 1;
  return options;
}

Clip opened(const Bytes& file) {
  Clip clip;
  EXPECT_EQ(clip.open(file).status, Status::kOk);
  return clip;
}

/// Largest difference of an attribute over all frames; both number vertices alike.
double largest_error(const Clip& clip, uint32_t number, const Attribute& source,
                     uint32_t first_frame = 0) {
  const size_t row = size_t{clip.vertex_count()} * source.components;
  std::vector<float> values(row);
  double largest = 0;
  for (uint32_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_EQ(clip.attribute_values(0, number, f, values.data()), Status::kOk);
    for (size_t i = 0; i < row; ++i)
      largest = std::max(largest, std::abs(double{values[i]} -
                                           double{source.values[(f + first_frame) * row + i]}));
  }
  return largest;
}

/// Bytes of the segments of attributes.
size_t attribute_segment_bytes(const Bytes& file) {
  ContainerReader reader;
  EXPECT_TRUE(reader.open(file).ok());
  const Clip clip = opened(file);
  size_t bytes = 0;
  for (const Chunk& chunk : reader.chunks()) {
    if (chunk.segment != kNoSegment &&
        clip.limits().segments[chunk.segment].attribute != kPositions)
      bytes += chunk.size;
  }
  return bytes;
}

class MovingAttributesOf : public testing::TestWithParam<BasisChoice> {};

TEST_P(MovingAttributesOf, StayWithinTheirErrorsOverAPoseOfThePositionsOrOfTheirOwn) {
  const MeshSequence clip = corpus::make_clip("heated");
  const EncodeResult result = encode(clip, coarse(GetParam()));
  const Clip back = opened(result.file);
  ASSERT_EQ(result.attributes.size(), 3U);
  for (uint32_t i = 0; i < 3; ++i) {
    const AttributeResult& a = result.attributes[i];
    EXPECT_EQ(a.name, clip.attributes[i].name);
    EXPECT_EQ(a.number, i);
    EXPECT_TRUE(a.kept) << a.note;
    EXPECT_GT(a.bytes, 0U);
    EXPECT_GT(a.components + 1, 0U);
    EXPECT_LE(a.max_error, a.asked);
    EXPECT_GT(a.rmse, 0);
    EXPECT_DOUBLE_EQ(largest_error(back, i, clip.attributes[i]), a.max_error);
    EXPECT_EQ(back.clips()[0].attribute_errors[i].attribute, i);
    EXPECT_EQ(back.clips()[0].attribute_errors[i].max_error, a.max_error);
    EXPECT_EQ(back.clips()[0].attribute_errors[i].rmse, a.rmse);
  }
  EXPECT_NEAR(result.attributes[1].asked, 0.5 / 255, 1e-9);
  EXPECT_EQ(back.frame_count(), clip.frame_count);
  // Alpha rests: of the colour, three components move.
  EXPECT_EQ(back.tracks().size(), 4U);
}

INSTANTIATE_TEST_SUITE_P(Bases, MovingAttributesOf,
                         testing::Values(BasisChoice::kKeyframes, BasisChoice::kEigenshapes,
                                         BasisChoice::kEigentrajectories));

TEST(SlowMovingAttributes, KeepToTheErrorThatIsAskedFor) {
  const MeshSequence clip = corpus::make_clip("heated");
  EncodeOptions options = coarse();
  options.attributes.error = 1;
  options.attributes.error_percent = true;
  const EncodeResult coarser = encode(clip, options);
  options.attributes.error = 0.02;
  options.attributes.error_percent = false;
  const EncodeResult finer = encode(clip, options);
  EXPECT_NEAR(coarser.attributes[2].asked, 4.6, 0.5);  // of some 460 degrees
  EXPECT_GT(coarser.attributes[2].max_error, 1);
  EXPECT_LE(finer.attributes[2].max_error, 0.02);
  EXPECT_GT(finer.attributes[2].bytes, coarser.attributes[2].bytes);
  options.attributes.error = 1e-7;
  EXPECT_THROW(encode(clip, options), Error);
}

TEST(MovingAttributes, LeavePositionsAsTheyAre) {
  MeshSequence clip = corpus::make_clip("heated");
  const Bytes with = encode(clip, coarse()).file;
  for (Attribute& a : clip.attributes) {
    a.values.resize(a.values.size() / a.frames);
    a.frames = 1;
  }
  const Bytes without = encode(clip, coarse()).file;
  EXPECT_EQ(attribute_segment_bytes(without), 0U);
  const Clip a = opened(with), b = opened(without);
  std::vector<float> x(size_t{3} * clip.vertex_count), y(x.size());
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    ASSERT_EQ(a.positions(0, f, x.data()), Status::kOk);
    ASSERT_EQ(b.positions(0, f, y.data()), Status::kOk);
    ASSERT_EQ(x, y);
  }
}

TEST(MovingAttributes, ThatDifferAtASeamStayAsInTheFirstFrame) {
  MeshSequence clip = corpus::make_clip("heated");
  Attribute& heat = clip.attributes[2];
  const size_t half = clip.vertex_count / 2;
  for (size_t i = clip.vertex_count; i < heat.values.size(); ++i)
    heat.values[i] += i % clip.vertex_count < half ? 10.0F : 0.0F;
  const EncodeResult result = encode(clip, coarse());
  EXPECT_TRUE(result.attributes[1].kept);
  EXPECT_FALSE(result.attributes[2].kept);
  EXPECT_THAT(result.attributes[2].note, testing::HasSubstr("first frame"));
  const Clip back = opened(result.file);
  std::vector<float> first(clip.vertex_count), last(clip.vertex_count);
  ASSERT_EQ(back.attribute_values(0, 2, 0, first.data()), Status::kOk);
  ASSERT_EQ(back.attribute_values(0, 2, clip.frame_count - 1, last.data()), Status::kOk);
  EXPECT_EQ(first, last);
  EXPECT_NEAR(first[5], heat.values[5], 0.5);
  // Seams stay closed: copies have one trajectory.
  EXPECT_EQ(back.limits().meshes[0].coded_vertices, 225U);
}

TEST(MovingAttributes, OfCornersStayAsInTheFirstFrame) {
  MeshSequence clip = corpus::make_clip("painted_box");
  Attribute& uv = clip.attributes[0];
  const FrameArray first = uv.values;
  for (uint32_t f = 1; f < clip.frame_count; ++f) {
    for (float x : first)
      uv.values.push_back(x + 0.01F * static_cast<float>(f));
  }
  uv.frames = clip.frame_count;
  const EncodeResult result = encode(clip, coarse());
  ASSERT_EQ(result.attributes.size(), 1U);
  EXPECT_FALSE(result.attributes[0].kept);
  EXPECT_THAT(result.attributes[0].note, testing::HasSubstr("corners"));
}

TEST(MovingAttributes, WithinTheirErrorTakeNoSegment) {
  MeshSequence clip = corpus::make_clip("heated");
  clip.attributes.resize(1);
  EncodeOptions options = coarse();
  options.attributes.error = 0.5;
  const EncodeResult result = encode(clip, options);
  EXPECT_TRUE(result.attributes[0].kept);
  EXPECT_EQ(result.attributes[0].bytes, 0U);
  EXPECT_LE(result.attributes[0].max_error, 0.5);
  EXPECT_EQ(attribute_segment_bytes(result.file), 0U);
}

TEST(MovingAttributes, HaveTheirValuesInAFileOfFreeOrder) {
  const MeshSequence clip = corpus::make_clip("heated");
  EncodeOptions options = coarse();
  options.order = OrderMode::kFree;
  for (const AttributeResult& a : encode(clip, options).attributes) {
    EXPECT_TRUE(a.kept);
    EXPECT_LE(a.max_error, a.asked);
  }
}

TEST(SlowMovingAttributes, CountForASizeThatIsAskedFor) {
  const MeshSequence clip = corpus::make_clip("heated");
  EncodeOptions options = coarse();
  const EncodeResult loose = encode(clip, options);
  const auto allowed = static_cast<double>(loose.file.size() + 400);
  options.target = {ErrorMetric::kSize, allowed, false};
  const EncodeResult result = encode(clip, options);
  EXPECT_LE(result.file.size(), allowed);
  EXPECT_GT(result.file.size(), loose.file.size());
  EXPECT_LT(result.rmse, loose.rmse);
  options.target.value = static_cast<double>(loose.attributes[1].bytes);
  EXPECT_THROW(encode(clip, options), Error);
}

TEST(SlowMovingAttributes, AreJoinedFromParts) {
  const MeshSequence clip = corpus::make_clip("heated");
  std::vector<Bytes> files;
  for (FrameRun part : {FrameRun{0, 14}, FrameRun{14, 10}}) {
    EncodeOptions options = coarse();
    options.part = part;
    files.push_back(encode(clip, options).file);
  }
  const Clip back = opened(join_clips({{"a", files[0]}, {"b", files[1]}}));
  ASSERT_EQ(back.frame_count(), clip.frame_count);
  ASSERT_EQ(back.clips()[0].attribute_errors.size(), 3U);
  for (uint32_t i = 0; i < 3; ++i)
    EXPECT_LE(largest_error(back, i, clip.attributes[i]),
              back.clips()[0].attribute_errors[i].max_error * (1 + 1e-9));
}

TEST(MovingAttributes, RefuseValuesThatDoNotFitOrAreNotFinite) {
  MeshSequence clip = corpus::make_clip("heated");
  clip.attributes[2].values[3000] = NAN;
  EXPECT_THROW(encode(clip, coarse()), Error);
  clip.attributes[2].values[3000] = 0;
  clip.attributes[2].frames = 7;
  EXPECT_THROW(encode(clip, coarse()), Error);
}

}  // namespace
}  // namespace anicodec
