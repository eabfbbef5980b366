// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/closest_point.h"

#include "codec/sequence/error.h"
#include "codec/sequence/random.h"
#include "corpus/clips.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

const Vector3d kA{0, 0, 0}, kB{4, 0, 0}, kC{0, 4, 0};

TEST(ClosestOnTriangle, InsideSidesAndCorners) {
  ClosestPoint inside = closest_on_triangle(kA, kB, kC, {1, 1, 3});
  EXPECT_DOUBLE_EQ(inside.square_distance, 9);
  EXPECT_DOUBLE_EQ(inside.weights[0], 0.5);
  EXPECT_DOUBLE_EQ(inside.weights[1], 0.25);
  EXPECT_DOUBLE_EQ(inside.position[1], 1);
  EXPECT_DOUBLE_EQ(closest_on_triangle(kA, kB, kC, {1, -2, 0}).square_distance, 4);
  EXPECT_DOUBLE_EQ(closest_on_triangle(kA, kB, kC, {3, 3, 0}).square_distance, 2);
  EXPECT_DOUBLE_EQ(closest_on_triangle(kA, kB, kC, {-3, -4, 0}).square_distance, 25);
  EXPECT_DOUBLE_EQ(closest_on_triangle(kA, kB, kC, {5, -1, 1}).square_distance, 3);
  EXPECT_EQ(closest_on_triangle(kA, kB, kC, kB).square_distance, 0);
}

TEST(ClosestOnTriangle, DegenerateTrianglesAreSegmentsOrPoints) {
  EXPECT_DOUBLE_EQ(closest_on_triangle(kA, kB, {2, 0, 0}, {3, 2, 0}).square_distance, 4);
  EXPECT_DOUBLE_EQ(closest_on_triangle(kA, kA, kB, {5, 0, 0}).square_distance, 1);
  ClosestPoint point = closest_on_triangle(kB, kB, kB, {4, 3, 0});
  EXPECT_DOUBLE_EQ(point.square_distance, 9);
  EXPECT_DOUBLE_EQ(point.position[0], 4);
}

ClosestPoint by_search(const std::vector<uint32_t>& triangles, std::span<const float> positions,
                       const Vector3d& q) {
  auto vertex = [&](uint32_t v) {
    return Vector3d{double{positions[3 * v]}, double{positions[3 * v + 1]},
                    double{positions[3 * v + 2]}};
  };
  ClosestPoint best;
  best.square_distance = std::numeric_limits<double>::infinity();
  for (uint32_t t = 0; t < triangles.size() / 3; ++t) {
    ClosestPoint c = closest_on_triangle(vertex(triangles[3 * t]), vertex(triangles[3 * t + 1]),
                                         vertex(triangles[3 * t + 2]), q);
    if (c.square_distance < best.square_distance) {
      best = c;
      best.element = t;
    }
  }
  for (uint32_t v = 0; triangles.empty() && v < positions.size() / 3; ++v) {
    double x = vertex(v)[0] - q[0], y = vertex(v)[1] - q[1], z = vertex(v)[2] - q[2];
    if (x * x + y * y + z * z < best.square_distance)
      best = {x * x + y * y + z * z, v, Vector3d::UnitX(), vertex(v)};
  }
  return best;
}

class ClosestPointOfClip : public testing::TestWithParam<std::string> {};

TEST_P(ClosestPointOfClip, IsThatOfASearchThroughAllElements) {
  MeshSequence s = corpus::make_clip(GetParam());
  auto positions = s.frame(s.frame_count - 1);
  std::vector<uint32_t> triangles = fan_triangles(s.polygons);
  ClosestPointQuery query(triangles, positions);
  double size = diagonal(s);
  LinearCongruence numbers(1);
  auto random = [&] { return numbers.symmetric(); };
  for (int i = 0; i < 400; ++i) {
    // On a vertex, near it, and away by powers of the size.
    uint32_t v = static_cast<uint32_t>((random() + 1) / 2 * s.vertex_count);
    double spread = i % 4 == 0 ? 0 : size * std::pow(10.0, i % 16 - 10);
    Vector3d q;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      q[axis] = double{positions[3 * v + static_cast<size_t>(axis)]} + spread * random();
    ClosestPoint expected = by_search(triangles, positions, q), got = query(q);
    ASSERT_EQ(got.square_distance, expected.square_distance) << i;
    ASSERT_EQ(got.element, expected.element) << i;
    ASSERT_EQ(got.weights, expected.weights) << i;
    ASSERT_EQ(got.position, expected.position) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(ClosestPoint, ClosestPointOfClip, testing::ValuesIn(corpus::clip_names()),
                         [](const auto& test) { return test.param; });

TEST(ClosestPointQuery, RefusesSurfacesWithoutVerticesOrNotFinite) {
  EXPECT_THROW(ClosestPointQuery({}, {}), Error);
  std::vector<float> bad{0, 0, std::numeric_limits<float>::infinity()};
  EXPECT_THROW(ClosestPointQuery({}, bad), Error);
}

TEST(ClosestPointQuery, CanBeMoved) {
  std::vector<float> positions{0, 0, 0, 1, 0, 0};
  ClosestPointQuery first({}, positions);
  ClosestPointQuery second = std::move(first);
  EXPECT_EQ(second({0.75, 0, 0}).element, 1U);
}

TEST(FanTriangles, StartAtTheFirstCorner) {
  Polygons p;
  p.add(std::vector<uint32_t>{4, 5, 6, 7, 8});
  p.add(std::vector<uint32_t>{1, 2});
  p.add(std::vector<uint32_t>{3, 3, 1});
  EXPECT_EQ(fan_triangles(p), (std::vector<uint32_t>{4, 5, 6, 4, 6, 7, 4, 7, 8, 3, 3, 1}));
}

}  // namespace
}  // namespace anicodec
