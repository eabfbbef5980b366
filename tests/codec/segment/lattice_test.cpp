// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/lattice.h"

#include "sdk/exact/exact_coding.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Some points of a lattice, as binary32, in no order and some of them often.
template <class Point>
std::vector<float> points(int count, int range, Point point) {
  std::mt19937 random(5);
  std::vector<float> all;
  for (int i = 0; i < count; ++i)
    all.push_back(static_cast<float>(
        point(static_cast<int>(random() % static_cast<unsigned>(range)) - range / 3)));
  return all;
}

void expect_found(const std::vector<float>& all, double step) {
  const ExactRecord::Lattice lattice = find_lattice(all, 1 << 20);
  ASSERT_TRUE(lattice.is_used());
  EXPECT_NEAR(lattice.step, step, 1e-6 * step);
  for (float x : all)
    ASSERT_LE(std::abs(ordinal(x) - ordinal(lattice_point(lattice, nearest_point(lattice, x)))), 1);
}

TEST(Lattice, IsFoundOfDecimalsFractionsAndQuantisedNumbers) {
  expect_found(points(50000, 40000, [](int k) { return k / 1e4; }), 1e-4);
  expect_found(points(50000, 40000, [](int k) { return k / 1024.0; }), 1.0 / 1024);
  expect_found(points(50000, 65536, [](int k) { return 12.3456 + k * 3.3e-5; }), 3.3e-5);
}

TEST(Lattice, IsFoundWhereFewOfItsPointsAreTaken) {
  expect_found(points(20000, 100000, [](int k) { return k / 1e3; }), 1e-3);
}

TEST(Lattice, IsNoneOfNumbersThatHaveNone) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0, 1);
  std::vector<float> all;
  for (int i = 0; i < 20000; ++i)
    all.push_back(normal(random));
  EXPECT_FALSE(find_lattice(all, 1 << 20).is_used());
  EXPECT_FALSE(find_lattice({}, 100).is_used());
  EXPECT_FALSE(find_lattice({1, 1, 1}, 100).is_used());
}

TEST(Lattice, HasNoMorePointsThanAllowed) {
  const std::vector<float> all = points(50000, 40000, [](int k) { return k / 1e4; });
  EXPECT_FALSE(find_lattice(all, 30000).errs);
  EXPECT_TRUE(find_lattice(points(50000, 40000, [](int k) { return k / 1024.0; }), 1).is_used());
}

}  // namespace
}  // namespace anicodec
