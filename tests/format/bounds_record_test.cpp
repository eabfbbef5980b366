// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/bounds_record.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// A box that walks along x and grows along y.
Vector<Box> walking(uint32_t frames) {
  Vector<Box> boxes;
  for (uint32_t f = 0; f < frames; ++f) {
    const auto x = static_cast<float>(f);
    boxes.push_back({{x, -1 - x / 7, 5}, {x + 2, 1 + x / 3, 5}});
  }
  return boxes;
}

bool holds(const Box& outer, const Box& inner) {
  for (size_t c = 0; c < 3; ++c) {
    if (outer.low[c] > inner.low[c] || outer.high[c] < inner.high[c])
      return false;
  }
  return true;
}

TEST(BoundsRecord, HoldsEveryFrame) {
  for (const uint32_t frames : {1U, 63U, 64U, 65U, 200U}) {
    const Vector<Box> boxes = walking(frames);
    BoundsRecord record, read;
    record.set(boxes, 64);
    const Bytes bytes = record.write();
    EXPECT_EQ(bytes.size(), BoundsRecord::unmeasured(frames, 64).write().size());
    ASSERT_EQ(BoundsRecord::read(bytes, frames, &read), Status::kOk);
    EXPECT_EQ(read.boxes.size(), frames <= 64 ? 0U : (frames + 63) / 64);
    for (uint32_t f = 0; f < frames; ++f)
      EXPECT_TRUE(holds(read.of_frame(f), boxes[f])) << f << " of " << frames;
  }
}

TEST(BoundsRecord, IsTightToA255th) {
  const Vector<Box> boxes = walking(200);
  BoundsRecord record;
  record.set(boxes, 64);
  const Box first = record.of_frame(0);
  EXPECT_NEAR(first.high[0], 65, 201.0 / 255 + 1e-3);
  EXPECT_EQ(first.low[2], 5);
  EXPECT_EQ(first.high[2], 5);
}

TEST(BoundsRecord, RefusesWhatIsNone) {
  BoundsRecord record, read;
  record.set(walking(200), 64);
  const Bytes good = record.write();
  for (size_t n = 0; n < good.size(); ++n)
    EXPECT_EQ(BoundsRecord::read({good.data(), n}, 200, &read), Status::kRecord) << n;
  EXPECT_EQ(BoundsRecord::read(good, 63, &read),
            Status::kRecord);  // shares more frames than there are
  EXPECT_EQ(BoundsRecord::read(good, 300, &read), Status::kRecord);  // a box is missing
  record.all.high[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(BoundsRecord::read(record.write(), 200, &read), Status::kRecord);
  record.all.high[1] = record.all.low[1] - 1;
  EXPECT_EQ(BoundsRecord::read(record.write(), 200, &read), Status::kRecord);
  Bytes more = good;
  more.insert(more.end(), {7, 1, 0});  // a field of a later version
  EXPECT_EQ(BoundsRecord::read(more, 200, &read), Status::kOk);
}

}  // namespace
}  // namespace anicodec
