// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/ray_hit.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// A height field of n x n squares, two triangles each.
struct Field {
  std::vector<float> points;
  std::vector<uint32_t> triangles;

  explicit Field(uint32_t n, std::mt19937& random) {
    std::uniform_real_distribution<float> height(0, 0.3F);
    for (uint32_t y = 0; y <= n; ++y) {
      for (uint32_t x = 0; x <= n; ++x) {
        points.insert(points.end(), {float(x) / 7, float(y) / 7, height(random)});
        const uint32_t v = y * (n + 1) + x;
        if (x < n && y < n)
          triangles.insert(triangles.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
      }
    }
  }

  void offer_all(RayHit* hit) const {
    for (uint32_t t = 0; t < triangles.size() / 3; ++t)
      hit->offer(t, at(3 * t), at(3 * t + 1), at(3 * t + 2));
  }

  const float* at(uint32_t corner) const { return points.data() + size_t{3} * triangles[corner]; }
};

TEST(RayHit, MissesNothingThroughEdgesAndVertices) {
  std::mt19937 random(3);
  const Field field(20, random);
  std::uniform_int_distribution<uint32_t> inner(1, 19);
  std::uniform_real_distribution<double> part(0, 1), slant(-0.2, 0.2);
  for (int i = 0; i < 20000; ++i) {
    const uint32_t v = inner(random) * 21 + inner(random);
    const uint32_t others[3] = {v + 1, v + 21, v + 22};
    const Vector3 a = vector_at(field.points.data() + size_t{3} * v),
                  b = vector_at(field.points.data() + size_t{3} * others[i % 3]);
    const Vector3 aim = a + (i % 4 == 0 ? 0 : part(random)) * (b - a);
    const Vector3 direction = {{slant(random), slant(random), -1}};
    RayHit hit(aim - 5 * direction, direction, INFINITY, RayHit::Side::kFront);
    field.offer_all(&hit);
    ASSERT_NE(hit.triangle(), RayHit::kNone);
    EXPECT_LE(hit.distance(), 5 + 1e-6);
    EXPECT_NEAR(hit.weight(0) + hit.weight(1) + hit.weight(2), 1, 1e-12);
  }
}

TEST(RayHit, KnowsSidesDistancesAndTheFirstOfEquals) {
  const float a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 1, 0};
  const Vector3 above = {{0.25, 0.5, 4}}, below = {{0.25, 0.5, -4}}, down = {{0, 0, -2}},
                up = {{0, 0, 2}};
  const auto meets = [&](const Vector3& from, const Vector3& along, double farthest,
                         RayHit::Side side) {
    RayHit hit(from, along, farthest, side);
    hit.offer(8, a, b, c);
    hit.offer(9, a, b, c);
    if (hit.triangle() == RayHit::kNone)
      return RayHit::Side::kAny;
    EXPECT_EQ(hit.triangle(), 8U);
    EXPECT_DOUBLE_EQ(hit.distance(), 2);
    EXPECT_DOUBLE_EQ(hit.weight(0), 0.25);
    EXPECT_DOUBLE_EQ(hit.weight(1), 0.25);
    EXPECT_DOUBLE_EQ(hit.weight(2), 0.5);
    return hit.side();
  };
  using Side = RayHit::Side;
  EXPECT_EQ(meets(above, down, INFINITY, Side::kAny), Side::kFront);
  EXPECT_EQ(meets(below, up, INFINITY, Side::kAny), Side::kBack);
  EXPECT_EQ(meets(above, down, 2, Side::kFront), Side::kFront);
  EXPECT_EQ(meets(below, up, 2, Side::kBack), Side::kBack);
  EXPECT_EQ(meets(above, down, 2, Side::kBack), Side::kAny);
  EXPECT_EQ(meets(below, up, 2, Side::kFront), Side::kAny);
  EXPECT_EQ(meets(above, down, 1.99, Side::kAny), Side::kAny);
  EXPECT_EQ(meets(above, up, INFINITY, Side::kAny), Side::kAny);
  EXPECT_EQ(meets(above, {{1, 0, 0}}, INFINITY, Side::kAny), Side::kAny);
}

TEST(RayHit, IgnoresTrianglesThatAreEdgeOnOrNotFinite) {
  RayHit hit({{-1, 0.25, 0}}, {{1, 0, 0}}, INFINITY, RayHit::Side::kAny);
  const float a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 1, 0}, nan[] = {0, NAN, 1},
              far[] = {0, INFINITY, 1};
  hit.offer(0, a, b, c);
  hit.offer(1, a, b, nan);
  hit.offer(2, a, a, a);
  hit.offer(3, a, c, far);
  EXPECT_EQ(hit.triangle(), RayHit::kNone);
}

TEST(RayHit, MeetsBoxes) {
  const float min[] = {-1, -1, -1}, max[] = {1, 1, 1};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-4, 4), within(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 from = {{anywhere(random), anywhere(random), anywhere(random)}},
                  inside = {{within(random), within(random), within(random)}};
    EXPECT_TRUE(RayHit(from, inside - from, INFINITY, RayHit::Side::kAny).meets_box(min, max));
    EXPECT_TRUE(RayHit(inside, from, 0.1, RayHit::Side::kAny).meets_box(min, max));
  }
  EXPECT_FALSE(RayHit({{2, 0, 0}}, {{0, 1, 0}}, INFINITY, RayHit::Side::kAny).meets_box(min, max));
  EXPECT_FALSE(RayHit({{2, 0, 0}}, {{1, 0, 0}}, INFINITY, RayHit::Side::kAny).meets_box(min, max));
  EXPECT_FALSE(RayHit({{4, 0, 0}}, {{-1, 0, 0}}, 2.9, RayHit::Side::kAny).meets_box(min, max));
  EXPECT_TRUE(RayHit({{1, 0, 5}}, {{0, 0, -1}}, INFINITY, RayHit::Side::kAny).meets_box(min, max));
}

}  // namespace
}  // namespace anicodec
