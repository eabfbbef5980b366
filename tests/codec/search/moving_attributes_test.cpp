// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/moving_attributes.h"

#include "codec/encode.h"
#include "codec/file/join_clips.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "format/container.h"
#include "sdk/clip/sample.h"

#include <algorithm>
#include <cmath>
#include <functional>
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
  options.effort = Effort::kFast;
  return options;
}

Clip opened(const Bytes& file) {
  Clip clip;
  EXPECT_EQ(clip.open(file).status, Status::kOk);
  return clip;
}

/// Largest difference of an attribute over all frames; both number elements alike.
double largest_error(const Clip& clip, uint32_t number, const Attribute& source,
                     uint32_t first_frame = 0) {
  const size_t row = source.values.size() / source.frames;
  std::vector<float> values(row);
  double largest = 0;
  for (uint32_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_EQ(show_attribute(clip, 0, number, f, values.data()), Status::kOk);
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
  options.attributes.error = {AttributeBound::Measure::kPercent, 1};
  const EncodeResult coarser = encode(clip, options);
  options.attributes.error = {AttributeBound::Measure::kUnits, 0.02};
  const EncodeResult finer = encode(clip, options);
  EXPECT_NEAR(coarser.attributes[2].asked, 4.6, 0.5);  // of some 460 degrees
  EXPECT_GT(coarser.attributes[2].max_error, 1);
  EXPECT_LE(finer.attributes[2].max_error, 0.02);
  EXPECT_GT(finer.attributes[2].bytes, coarser.attributes[2].bytes);
  options.attributes.error = {AttributeBound::Measure::kUnits, 1e-7};
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
    ASSERT_EQ(show_positions(a, 0, f, x.data()), Status::kOk);
    ASSERT_EQ(show_positions(b, 0, f, y.data()), Status::kOk);
    ASSERT_EQ(x, y);
  }
}

TEST(MovingAttributes, ThatDifferAtASeamMoveApart) {
  MeshSequence clip = corpus::make_clip("heated");
  Attribute& heat = clip.attributes[2];
  const size_t half = clip.vertex_count / 2;
  for (size_t i = clip.vertex_count; i < heat.values.size(); ++i)
    heat.values[i] += i % clip.vertex_count < half ? 10.0F : 0.0F;
  const EncodeResult result = encode(clip, coarse());
  const Clip back = opened(result.file);
  EXPECT_LE(largest_error(back, 2, heat), result.attributes[2].asked);
  // Seams stay closed: copies have one trajectory.
  EXPECT_EQ(back.limits().meshes[0].coded_vertices, 225U);
}

/// Frames of an attribute that begin with what it has.
void move(MeshSequence& clip, Attribute& attribute,
          const std::function<float(size_t element, uint32_t component, uint32_t frame)>& by) {
  const FrameArray first = attribute.values;
  for (uint32_t f = 1; f < clip.frame_count; ++f) {
    for (size_t i = 0; i < first.size(); ++i)
      attribute.values.push_back(first[i] + by(i / attribute.components,
                                               static_cast<uint32_t>(i % attribute.components), f));
  }
  attribute.frames = clip.frame_count;
}

TEST(MovingAttributes, TextureCoordinatesThatScrollTakeNoComponent) {
  for (const OrderMode order : {OrderMode::kVertices, OrderMode::kFree, OrderMode::kAll}) {
    MeshSequence clip = corpus::make_clip("painted_box");
    Attribute& uv = clip.attributes[0];
    ASSERT_TRUE(uv.per_corner());
    move(clip, uv, [](size_t, uint32_t component, uint32_t f) {
      return (component == 0 ? 0.01F : -0.004F) * static_cast<float>(f);
    });
    EncodeOptions options = coarse();
    options.order = order;
    const EncodeResult result = encode(clip, options);
    ASSERT_EQ(result.attributes.size(), 1U);
    const AttributeResult& a = result.attributes[0];
    EXPECT_LE(a.max_error, a.asked);
    EXPECT_GT(a.max_error, 0);
    EXPECT_EQ(a.components, 0U);
    EXPECT_LT(a.bytes, 250U);
    if (order == OrderMode::kAll) {
      EXPECT_LE(largest_error(opened(result.file), a.number, uv), a.asked);
    }
  }
}

TEST(MovingAttributes, OfCornersMoveOnTheirOwn) {
  MeshSequence clip = corpus::make_clip("painted_box");
  clip.attributes.resize(1);
  Attribute& uv = clip.attributes[0];
  move(clip, uv, [](size_t corner, uint32_t component, uint32_t f) {
    return 0.02F * static_cast<float>((corner * 7 + component) % 5) *
           std::sin(0.7F * static_cast<float>(f));
  });
  EncodeOptions options = coarse();
  options.order = OrderMode::kAll;
  const EncodeResult result = encode(clip, options);
  EXPECT_GT(result.attributes[0].components, 0U);
  EXPECT_LE(largest_error(opened(result.file), 0, uv), result.attributes[0].asked);
}

TEST(MovingAttributes, OfPolygonsAreNumbersOfCells) {
  MeshSequence clip = corpus::make_clip("heated");
  clip.attributes.clear();
  Attribute pressure;
  pressure.kind = AttributeKind::kCustom;
  pressure.name = "pressure";
  pressure.domain = AttributeDomain::kPolygon;
  pressure.components = 4;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    for (size_t p = 0; p < clip.polygons.size(); ++p) {
      const uint32_t v = clip.polygons[p][0];
      const double x = static_cast<double>(clip.frame(0)[3 * v]), t = 0.1 * f;
      for (int k = 0; k < 4; ++k)
        pressure.values.push_back(static_cast<float>(100 * k + 5 * std::sin(x + t + k)));
    }
  }
  pressure.frames = clip.frame_count;
  clip.attributes.push_back(pressure);
  Attribute paint = pressure;
  paint.kind = AttributeKind::kColour;
  paint.name = "paint";
  paint.components = 3;
  paint.frames = 1;
  paint.values.resize(3 * clip.polygons.size());
  for (size_t i = 0; i < paint.values.size(); ++i)
    paint.values[i] = static_cast<float>(i / 30 % 4) / 4;
  clip.attributes.push_back(paint);
  EncodeOptions options = coarse();
  options.order = OrderMode::kAll;
  const EncodeResult result = encode(clip, options);
  const Clip back = opened(result.file);
  ASSERT_EQ(back.meshes()[0].attributes.size(), 2U);
  EXPECT_EQ(back.meshes()[0].attributes[0].header.domain, AttributeDomain::kPolygon);
  EXPECT_LE(largest_error(back, 0, pressure), result.attributes[0].asked);
  EXPECT_EQ(back.tracks().size(), 3U);
  const Vector<float>& painted = back.meshes()[0].attributes[1].values;
  ASSERT_EQ(painted.size(), paint.values.size());
  for (size_t i = 0; i < painted.size(); ++i)
    ASSERT_NEAR(painted[i], paint.values[i], 0.5 / 255 + 1e-6);
}

TEST(MovingAttributes, WithinTheirErrorTakeNoSegment) {
  MeshSequence clip = corpus::make_clip("heated");
  clip.attributes.resize(1);
  EncodeOptions options = coarse();
  options.attributes.error = {AttributeBound::Measure::kUnits, 0.5};
  const EncodeResult result = encode(clip, options);
  EXPECT_EQ(result.attributes[0].bytes, 0U);
  EXPECT_LE(result.attributes[0].max_error, 0.5);
  EXPECT_EQ(attribute_segment_bytes(result.file), 0U);
}

TEST(MovingAttributes, HaveTheirValuesInAFileOfFreeOrder) {
  const MeshSequence clip = corpus::make_clip("heated");
  EncodeOptions options = coarse();
  options.order = OrderMode::kFree;
  for (const AttributeResult& a : encode(clip, options).attributes) {
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

/// The text of the error that encoding ends with.
std::string fault_of(const MeshSequence& clip) {
  try {
    encode(clip, coarse());
  } catch (const Error& e) {
    return e.what();
  }
  return "none";
}

TEST(MovingAttributes, HaveBoundsOfTheirOwn) {
  using Measure = AttributeBound::Measure;
  MeshSequence clip = corpus::make_clip("heated");
  clip.attributes[0].bound = {Measure::kUnits, 0.01};
  clip.attributes[2].bound = {Measure::kPercent, 2};
  clip.attributes[2].unit = "K";
  const EncodeResult result = encode(clip, coarse());
  EXPECT_EQ(result.attributes[0].asked, 0.01);
  EXPECT_NEAR(result.attributes[1].asked, 0.5 / 255, 1e-9);
  EXPECT_NEAR(result.attributes[2].asked, 9.2, 1);  // of some 460 degrees
  for (const AttributeResult& a : result.attributes)
    EXPECT_LE(a.max_error, a.asked);
  EXPECT_LT(result.attributes[2].bytes,
            encode(corpus::make_clip("heated"), coarse()).attributes[2].bytes);
}

TEST(MovingAttributes, TakeAsManyBytesInSmallUnits) {
  MeshSequence clip = corpus::make_clip("heated");
  clip.attributes.erase(clip.attributes.begin(), clip.attributes.begin() + 2);
  EncodeOptions options = coarse();
  options.effort = Effort::kNormal;
  const auto bytes = static_cast<double>(encode(clip, options).attributes[0].bytes);
  for (float& value : clip.attributes[0].values)
    value *= 1e5F;
  EXPECT_NEAR(static_cast<double>(encode(clip, options).attributes[0].bytes), bytes, 0.03 * bytes);
}

TEST(MovingAttributes, OfWholeNumbersAreExactOnceRounded) {
  MeshSequence clip = corpus::make_clip("heated");
  Attribute& phase = clip.attributes[2];
  phase.bound = {AttributeBound::Measure::kExact};
  for (float& value : phase.values)
    value = std::floor(value / 50);
  const Clip back = opened(encode(clip, coarse()).file);
  const size_t row = phase.values.size() / phase.frames;
  std::vector<float> values(row);
  for (uint32_t f = 0; f < phase.frames; ++f) {
    ASSERT_EQ(show_attribute(back, 0, 2, f, values.data()), Status::kOk);
    for (size_t i = 0; i < row; ++i)
      ASSERT_EQ(std::round(values[i]), phase.values[f * row + i]);
  }
  phase.values[row + 3] = 1.5;
  EXPECT_THAT(fault_of(clip), testing::HasSubstr("frame 1, vertex 3: 1.5"));
  phase.values[row + 3] = 1e6;
  EXPECT_THAT(fault_of(clip), testing::HasSubstr("it is no whole number of at most 262144"));
}

TEST(MovingAttributes, RefuseValuesThatDoNotFitOrAreNotFinite) {
  MeshSequence clip = corpus::make_clip("heated");
  const size_t row = clip.attributes[2].values.size() / clip.attributes[2].frames;
  clip.attributes[2].values[7 * row + 5] = NAN;
  EXPECT_THAT(fault_of(clip), testing::HasSubstr("frame 7, vertex 5: the value is not finite"));
  clip.attributes[2].values[7 * row + 5] = 0;
  clip.attributes[2].frames = 7;
  EXPECT_THROW(encode(clip, coarse()), Error);
}

}  // namespace
}  // namespace anicodec
