// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/record_fields.h"

#include "format/records.h"
#include "tests/format/three_frames.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

bool skips(const Bytes& bytes) {
  ByteReader r(bytes);
  return skip_fields(r);
}

TEST(RecordFields, AreSkippedWhereTheyAreNotKnown) {
  EXPECT_TRUE(skips({}));
  EXPECT_TRUE(skips({5, 1, 7}));
  EXPECT_TRUE(skips({5, 0, 6, 2, 1, 2}));
}

TEST(RecordFields, AscendAndEndWithinTheRecord) {
  EXPECT_FALSE(skips({0, 1, 7}));           // tag 0
  EXPECT_FALSE(skips({5, 1, 7, 5, 1, 7}));  // twice
  EXPECT_FALSE(skips({5, 1, 7, 4, 0}));
  EXPECT_FALSE(skips({5, 2, 7}));  // longer than the record
  EXPECT_FALSE(skips({5}));
}

TEST(RecordFields, OfLimitsSayWhatAContinuationFollows) {
  Limits limits = three_frames(), read;
  ASSERT_EQ(Limits::read(limits.write(), &read), Status::kOk);
  EXPECT_FALSE(read.continued_meshes);
  limits.continued_meshes = 0x0123456789ABCDEF;
  Bytes bytes = limits.write();
  ASSERT_EQ(Limits::read(bytes, &read), Status::kOk);
  EXPECT_EQ(read.continued_meshes, limits.continued_meshes);
  bytes.insert(bytes.end(), {9, 2, 1, 2});  // a field of a later version
  ASSERT_EQ(Limits::read(bytes, &read), Status::kOk);
  EXPECT_EQ(read.continued_meshes, limits.continued_meshes);
  bytes.push_back(9);
  EXPECT_EQ(Limits::read(bytes, &read), Status::kRecord);
}

TEST(RecordFields, OfAKnownTagHaveTheirSize) {
  const Bytes limits = three_frames().write();
  for (const uint8_t size : {uint8_t{0}, uint8_t{7}, uint8_t{9}}) {
    Bytes bytes = limits;
    bytes.insert(bytes.end(), {1, size});
    bytes.resize(bytes.size() + size);
    Limits read;
    EXPECT_EQ(Limits::read(bytes, &read), Status::kRecord);
  }
}

TEST(RecordFields, OfClipsSayWherePositionsCountFrom) {
  Limits limits;
  limits.clip_frames = {3};
  ClipsRecord clips, read;
  const Bytes none = clips.write();
  clips.origin[1] = -0.1;
  const Bytes bytes = clips.write();
  EXPECT_EQ(bytes.size(), none.size() + 26) << "tag, size, three numbers";
  ASSERT_EQ(ClipsRecord::read(bytes, limits, &read), Status::kOk);
  EXPECT_TRUE(read.has_origin());
  EXPECT_TRUE(read.same_origin(clips));
  ASSERT_EQ(ClipsRecord::read(none, limits, &read), Status::kOk);
  EXPECT_FALSE(read.has_origin());
  for (const uint8_t size : {uint8_t{0}, uint8_t{23}, uint8_t{25}}) {
    Bytes other = none;
    other.insert(other.end(), {1, size});
    other.resize(other.size() + size);
    EXPECT_EQ(ClipsRecord::read(other, limits, &read), Status::kRecord);
  }
  for (const double x : {std::nan(""), -std::numeric_limits<double>::infinity()}) {
    clips.origin[2] = x;
    EXPECT_EQ(ClipsRecord::read(clips.write(), limits, &read), Status::kRecord);
  }
}

TEST(RecordFields, OfSegmentsSayWhatTheyContinue) {
  SegmentRecord segment, read;
  read.continued = 5;
  ASSERT_EQ(SegmentRecord::read(segment.write(), &read), Status::kOk);
  EXPECT_EQ(read.continued, 0U);
  segment.continued = 0x0123456789ABCDEF;
  ASSERT_EQ(SegmentRecord::read(segment.write(), &read), Status::kOk);
  EXPECT_EQ(read.continued, segment.continued);
  segment.continued = 0;
  for (const uint8_t size :
       {uint8_t{0}, uint8_t{7}, uint8_t{8}, uint8_t{9}}) {  // of 8 bytes, 0 is none
    Bytes bytes = segment.write();
    bytes.insert(bytes.end(), {1, size});
    bytes.resize(bytes.size() + size);
    EXPECT_EQ(SegmentRecord::read(bytes, &read), Status::kRecord);
  }
}

TEST(RecordFields, MayFollowClipsAndSegments) {
  SegmentRecord segment;
  Bytes bytes = segment.write();
  bytes.insert(bytes.end(), {40, 1, 0});
  EXPECT_EQ(SegmentRecord::read(bytes, &segment), Status::kOk);
  bytes.push_back(1);
  EXPECT_EQ(SegmentRecord::read(bytes, &segment), Status::kRecord);
  Limits limits;
  limits.clip_frames = {3};
  ClipsRecord clips;
  bytes = clips.write();
  bytes.insert(bytes.end(), {40, 1, 0});
  EXPECT_EQ(ClipsRecord::read(bytes, limits, &clips), Status::kOk);
  bytes.push_back(1);
  EXPECT_EQ(ClipsRecord::read(bytes, limits, &clips), Status::kRecord);
}

}  // namespace
}  // namespace anicodec
