// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/polygon_cutter.h"

#include "tests/random.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Outline {
  std::vector<float> positions;

  uint32_t corners() const { return static_cast<uint32_t>(positions.size() / 3); }

  void add(double x, double y) {
    positions.insert(positions.end(), {static_cast<float>(x), static_cast<float>(y), 0});
  }

  /// Twice the signed area of a triangle, seen from above.
  double area(const uint32_t* t) const {
    const auto at = [&](uint32_t corner) { return vector_at(&positions[size_t{3} * corner]); };
    return cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]))[2];
  }
};

Vector<uint32_t> cut(const Outline& outline) {
  std::vector<uint32_t> vertices(outline.corners());
  std::iota(vertices.begin(), vertices.end(), 0U);
  Vector<uint32_t> triangles;
  PolygonCutter cutter(outline.positions.data(), vertices.size());
  cutter.cut(vertices.data(), outline.corners(), &triangles);
  return triangles;
}

/// How many of the triangles are turned against the others. None of a polygon that does not cross itself: the triangles then
/// cover it once, as the turns of its outline around any point are the sum of theirs.
uint32_t turned(const Outline& outline, const Vector<uint32_t>& triangles) {
  EXPECT_EQ(triangles.size(), 3 * (size_t{outline.corners()} - 2));
  uint32_t count = 0;
  for (size_t t = 0; t < triangles.size(); t += 3)
    count += outline.area(&triangles[t]) < -1e-6;
  return count;
}

TEST(PolygonCutter, CoversStarsOfAnyShapeOnce) {
  SmallRandom random(5);
  for (int i = 0; i < 300; ++i) {
    Outline star;
    const uint32_t corners = 4 + random.below(60);
    for (uint32_t c = 0; c < corners; ++c) {
      const double angle = 2 * 3.14159265358979 * c / corners, radius = 1.05 + random.symmetric();
      star.add(radius * std::cos(angle), radius * std::sin(angle));
    }
    ASSERT_EQ(turned(star, cut(star)), 0U) << i;
  }
}

TEST(PolygonCutter, CoversASpiralOnce) {
  Outline spiral;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i)
    spiral.add((1 + 0.1 * i) * std::cos(0.2 * i), (1 + 0.1 * i) * std::sin(0.2 * i));
  for (int i = kSteps; i-- > 0;)
    spiral.add((0.5 + 0.1 * i) * std::cos(0.2 * i), (0.5 + 0.1 * i) * std::sin(0.2 * i));
  // Its turns run clockwise or not: all triangles must do alike.
  const Vector<uint32_t> triangles = cut(spiral);
  const uint32_t against = turned(spiral, triangles);
  EXPECT_TRUE(against == 0 || against == triangles.size() / 3) << against;
}

TEST(PolygonCutter, LeavesAFanWhereComparisonsRunOut) {
  // Every second corner turns inwards: each ear is compared with half of the outline.
  Outline comb;
  constexpr uint32_t kTeeth = 20000;
  for (uint32_t i = 0; i < kTeeth; ++i)
    comb.add(i, i % 2);
  comb.add(kTeeth, -2);
  comb.add(0, -2);
  const Vector<uint32_t> triangles = cut(comb);
  EXPECT_EQ(triangles.size(), 3 * (size_t{comb.corners()} - 2));
}

TEST(PolygonCutter, LeavesFansWithoutPositions) {
  const std::vector<uint32_t> vertices = {9, 9, 9, 9, 9};
  Vector<uint32_t> triangles;
  PolygonCutter cutter(nullptr, vertices.size());
  for (const uint32_t corners : {5U, 3U, 2U, 1U, 0U})
    cutter.cut(vertices.data(), corners, &triangles);
  EXPECT_EQ(triangles, (Vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 1, 2}));
}

}  // namespace
}  // namespace anicodec
