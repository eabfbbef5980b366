// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/exact_record.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

ExactRecord exact_sample() {
  ExactRecord record;
  record.hash = 0x123456789ABCDEF0;
  record.noise = 1e-9;
  record.lattices[0] = {0.5, 0.25, -7, 12, true};
  record.lattices[2] = {-1, 1e-5, 3, 1000, false};
  return record;
}

Status read(const Bytes& bytes, ExactRecord* out) {
  Limits::Segment segment;
  segment.frames = 4;
  Limits::Mesh mesh;
  mesh.coded_vertices = 3;
  return ExactRecord::read(bytes, segment, mesh, out);
}

Status exact_status(const ExactRecord& record) {
  ExactRecord out;
  return read(record.write(), &out);
}

TEST(ExactRecord, ComesBack) {
  ExactRecord record = exact_sample();
  const Bytes stream = {1, 2, 3};
  record.stream = stream;
  const Bytes bytes = record.write();
  ExactRecord out;
  ASSERT_EQ(read(bytes, &out), Status::kOk);
  EXPECT_EQ(out.hash, record.hash);
  EXPECT_EQ(out.noise, record.noise);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(out.lattices[axis].is_used(), axis != 1);
    EXPECT_EQ(out.lattices[axis].origin, record.lattices[axis].origin);
    EXPECT_EQ(out.lattices[axis].step, record.lattices[axis].step);
    EXPECT_EQ(out.lattices[axis].first, record.lattices[axis].first);
    EXPECT_EQ(out.lattices[axis].count, record.lattices[axis].count);
    EXPECT_EQ(out.lattices[axis].errs, record.lattices[axis].errs);
  }
  ASSERT_EQ(out.stream.size, 3U);
  EXPECT_EQ(out.stream.data[2], 3);
  EXPECT_EQ(out.write(), bytes);
}

TEST(ExactRecord, RefusesEachFieldOutOfItsRange) {
  EXPECT_EQ(exact_status(exact_sample()), Status::kOk);
  ExactRecord record = exact_sample();
  for (double noise : {0.0, -1.0, double{INFINITY}, std::numeric_limits<double>::quiet_NaN()}) {
    record.noise = noise;
    EXPECT_EQ(exact_status(record), Status::kQuantizer) << noise;
  }
  record = exact_sample();
  record.lattices[0].origin = INFINITY;
  EXPECT_EQ(exact_status(record), Status::kQuantizer);
  record = exact_sample();
  record.lattices[2].step = INFINITY;
  EXPECT_EQ(exact_status(record), Status::kQuantizer);
  for (uint32_t count : {0U, 13U}) {
    record = exact_sample();
    record.lattices[0].count = count;
    EXPECT_EQ(exact_status(record), Status::kRecord) << count;
  }
  Bytes bytes = exact_sample().write();
  ExactRecord out;
  for (uint8_t axes : {0x40, 0x80, 0x1F}) {
    bytes[0] = axes;
    EXPECT_EQ(read(bytes, &out), Status::kRecord);
  }
  bytes = exact_sample().write();
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_EQ(read(bytes, &out), Status::kRecord) << bytes.size();
  }
}

}  // namespace
}  // namespace anicodec
