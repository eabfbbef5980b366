// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/position_box.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

PositionBox box_of(const std::vector<float>& positions) {
  PositionBox box;
  box.add(positions);
  return box;
}

TEST(PositionBox, KnowsItsSizeAndItsFarthestCoordinate) {
  PositionBox box = box_of({1, 2, -3});
  EXPECT_EQ(box.size(), 0);
  box.add(std::vector<float>{4, -2, -3, 2, 2, -3});
  EXPECT_EQ(box.size(), 5);
  EXPECT_EQ(box.farthest(), 4);
  EXPECT_EQ(box.rounding(), 0x1p-23) << "numbers below 4 are 2^-22 apart";
}

TEST(PositionBox, IsFarWhereFloat32IsCoarseForItsSize) {
  EXPECT_FALSE(box_of({0, 0, 0, 3, 4, 0}).is_far());
  EXPECT_FALSE(box_of({3000, 0, 0, 3003, 4, 0}).is_far());
  EXPECT_TRUE(box_of({5000, 0, 0, 5003, 4, 0}).is_far());
  EXPECT_TRUE(box_of({0, -5000, 0, 3, -4996, 0}).is_far());
  EXPECT_FALSE(box_of({5000, 0, 0, 5000, 0, 0}).is_far()) << "a point has no size";
}

TEST(PositionBox, HasAMiddleFromWhichFloat32KeepsWhatItHad) {
  const std::vector<float> positions{500000.03F, 4649776.5F, 120.01F, 500002, 4649779.5F, 120.09F};
  const PositionBox box = box_of(positions);
  const Point middle = box.middle();
  for (size_t i = 0; i < positions.size(); ++i) {
    const double rest = static_cast<double>(positions[i]) - middle[i % 3];
    EXPECT_EQ(static_cast<double>(static_cast<float>(rest)), rest);
    EXPECT_LE(std::abs(rest), box.size());
  }
  EXPECT_EQ(middle, (Point{500000, 4649780, 120}));
}

}  // namespace
}  // namespace anicodec
