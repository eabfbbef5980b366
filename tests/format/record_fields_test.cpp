// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/record_fields.h"

#include "format/records.h"
#include "tests/format/three_frames.h"

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
