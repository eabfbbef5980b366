// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/root_record.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Limits limits_of(uint32_t root_frames) {
  Limits limits;
  limits.clip_frames = {5, 7, 9};
  limits.frames = 21;
  limits.root_frames = root_frames;
  return limits;
}

RootRecord root_sample() {
  RootRecord record;
  record.clips.resize(3);
  record.clips[0] = {RootRecord::kMoves, {1, 2}, 0.5, 1};
  record.clips[2] = {RootRecord::kMoves | RootRecord::kTurns, {-1, 3}, 0.25, 0.125};
  return record;
}

Status root_status(const RootRecord& record, uint32_t root_frames = 14) {
  const Bytes bytes = record.write();
  RootRecord read;
  return RootRecord::read(bytes, limits_of(root_frames), &read);
}

TEST(RootRecord, ComesBack) {
  RootRecord record = root_sample();
  const Bytes stream = {1, 2, 3};
  record.stream = stream;
  const Bytes bytes = record.write();
  RootRecord read;
  ASSERT_EQ(RootRecord::read(bytes, limits_of(14), &read), Status::kOk);
  ASSERT_EQ(read.clips.size(), 3U);
  EXPECT_EQ(read.clips[0].series(), 2U);
  EXPECT_EQ(read.clips[1].series(), 0U);
  EXPECT_EQ(read.clips[2].series(), 3U);
  EXPECT_EQ(read.clips[2].pivot[1], 3);
  EXPECT_EQ(read.clips[2].turn_step, 0.125);
  EXPECT_EQ(read.stream.size, 3U);
  EXPECT_EQ(read.write(), bytes);
}

TEST(RootRecord, RefusesWhatMakesNoSense) {
  EXPECT_EQ(root_status(root_sample()), Status::kOk);
  EXPECT_EQ(root_status(root_sample(), 13), Status::kRecord);
  RootRecord record = root_sample();
  record.clips[1].holds = 4;
  EXPECT_EQ(root_status(record), Status::kRecord);
  for (double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    record = root_sample();
    record.clips[0].step = bad;
    EXPECT_EQ(root_status(record), Status::kQuantizer) << bad;
    record = root_sample();
    record.clips[2].turn_step = bad;
    EXPECT_EQ(root_status(record), Status::kQuantizer) << bad;
  }
  record = root_sample();
  record.clips[2].pivot[0] = std::nan("");
  EXPECT_EQ(root_status(record), Status::kQuantizer);
  const Bytes bytes = root_sample().write();
  for (size_t size = 0; size < bytes.size(); ++size) {
    RootRecord read;
    EXPECT_EQ(RootRecord::read({bytes.data(), size}, limits_of(14), &read), Status::kRecord)
        << size;
  }
}

}  // namespace
}  // namespace anicodec
