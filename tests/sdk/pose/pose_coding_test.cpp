// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_coding.h"

#include "sdk/pose/dependent_steps.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Sample {
  Topology topology;
  Vector<int32_t> pose;
};

/// A bent sheet of (n + 1)^2 vertices.
Sample sheet(uint32_t n) {
  Sample s;
  s.topology.coded_vertices = (n + 1) * (n + 1);
  for (uint32_t y = 0; y <= n; ++y) {
    for (uint32_t x = 0; x <= n; ++x) {
      double u = 6.0 * x / n, v = 4.0 * y / n;
      for (double p : {1000 * u, 1000 * v, 800 * std::sin(u) * std::cos(v)})
        s.pose.push_back(static_cast<int32_t>(std::lround(p)));
      if (x == n || y == n)
        continue;
      uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      s.topology.triangles.insert(s.topology.triangles.end(), {a, b, d, a, d, c});
    }
  }
  return s;
}

Sample random_sample(uint32_t vertices, size_t triangles, int32_t range, unsigned seed) {
  std::mt19937 random(seed);
  Sample s;
  s.topology.coded_vertices = vertices;
  for (size_t i = 0; i < 3 * triangles; ++i)
    s.topology.triangles.push_back(static_cast<uint32_t>(random() % vertices));
  std::uniform_int_distribution<int32_t> x(-range, range);
  for (size_t i = 0; i < size_t{3} * vertices; ++i)
    s.pose.push_back(x(random));
  return s;
}

/// The nearest pose that dependent steps allow, one entry after the other.
Vector<int32_t> dependent(const PoseSurface& surface, Vector<int32_t> pose) {
  for (size_t axis = 0; axis < 3; ++axis) {
    size_t state = 0;
    for (uint32_t v : surface.order) {
      int32_t& x = pose[size_t{3} * v + axis];
      const int32_t parity = DependentSteps::parity(state), half = (x - parity) / 2;
      x = 2 * half + parity;
      state = DependentSteps::next(state, half);
    }
  }
  return pose;
}

void expect_round_trip(const Sample& s) {
  const PoseSurface surface(s.topology);
  for (PoseCoding coding : {PoseCoding::kRounded, PoseCoding::kExact, PoseCoding::kDependent}) {
    const Vector<int32_t> pose =
        coding == PoseCoding::kDependent ? dependent(surface, s.pose) : s.pose;
    const Bytes bytes = encode_pose(surface, coding, pose);
    Vector<int32_t> decoded;
    ASSERT_EQ(decode_pose(bytes, surface, coding, &decoded), Status::kOk);
    EXPECT_EQ(decoded, pose);
  }
}

TEST(PoseCoding, ASmoothSheetTakesFewBits) {
  Sample s = sheet(40);
  expect_round_trip(s);
  const PoseSurface surface(s.topology);
  EXPECT_LT(encode_pose(surface, PoseCoding::kRounded, s.pose).size() * 8,
            6U * s.topology.coded_vertices);
}

TEST(PoseCoding, CoordinatesThatRepeatTakeLessThanHalfWhenExact) {
  Sample s = sheet(40);
  for (size_t i = 0; i < s.pose.size(); ++i)
    s.pose[i] = i % 3 == 0 ? s.pose[i] / 700 * 700 : i % 3 == 1 ? 100 * (s.pose[i] / 900) : 7;
  const PoseSurface surface(s.topology);
  EXPECT_LT(2 * encode_pose(surface, PoseCoding::kExact, s.pose).size(),
            encode_pose(surface, PoseCoding::kRounded, s.pose).size());
}

TEST(PoseCoding, AnyTrianglesAndPositionsComeBack) {
  for (unsigned seed = 0; seed < 20; ++seed)
    expect_round_trip(random_sample(1 + seed * 7, seed * 20, 1 << seed, seed));
  expect_round_trip(random_sample(60, 100, kMaxPoseCoordinate, 7));
}

TEST(PoseCoding, ExtremeCoordinatesComeBack) {
  Sample s = sheet(6);
  for (size_t i = 0; i < s.pose.size(); ++i)
    s.pose[i] = (i % 3 == 0 ? -1 : i % 2 == 0 ? 1 : 0) * kMaxPoseCoordinate;
  expect_round_trip(s);
}

TEST(PoseCoding, PointsWithoutTrianglesComeBack) {
  expect_round_trip(random_sample(50, 0, 1000, 1));
  expect_round_trip(random_sample(1, 0, 1000, 1));
  expect_round_trip(Sample{});
}

TEST(PoseCoding, FlatAndConstantPosesComeBack) {
  Sample s = sheet(12);
  for (size_t i = 2; i < s.pose.size(); i += 3)
    s.pose[i] = 5;
  expect_round_trip(s);
  s.pose.assign(s.pose.size(), 0);
  expect_round_trip(s);
}

TEST(PoseCoding, AVertexOfVeryManyTrianglesTakesBoundedTime) {
  Sample s = random_sample(20000, 0, 100000, 2);
  for (uint32_t v = 1; v + 1 < s.topology.coded_vertices; ++v)
    s.topology.triangles.insert(s.topology.triangles.end(), {0, v, v + 1});
  for (uint32_t v = 2; v < s.topology.coded_vertices; ++v)
    s.topology.triangles.insert(s.topology.triangles.end(), {0, 1, v});
  expect_round_trip(s);
}

TEST(PoseCoding, TruncatedStreamsAreRefused) {
  const Sample s = sheet(12);
  const PoseSurface surface(s.topology);
  for (PoseCoding coding : {PoseCoding::kRounded, PoseCoding::kExact}) {
    Bytes bytes = encode_pose(surface, coding, s.pose);
    Vector<int32_t> decoded;
    // No bytes at all are the stream of some pose.
    for (size_t size = 1; size < bytes.size(); ++size) {
      const Status status = decode_pose({bytes.data(), size}, surface, coding, &decoded);
      // Without its last bytes it may be the stream of another pose.
      if (size + 8 < bytes.size()) {
        EXPECT_EQ(status, Status::kEntropy) << size;
      } else {
        EXPECT_NE(decoded, s.pose) << size;
      }
    }
    bytes.push_back(1);
    EXPECT_EQ(decode_pose(bytes, surface, coding, &decoded), Status::kEntropy);
  }
}

TEST(PoseCoding, ArbitraryBytesDoNoHarm) {
  const Sample s = sheet(10);
  const PoseSurface surface(s.topology);
  std::mt19937 random(5);
  Vector<int32_t> decoded;
  for (int round = 0; round < 600; ++round) {
    Bytes bytes(random() % 600);
    for (uint8_t& b : bytes)
      b = static_cast<uint8_t>(round % 4 == 0 ? 255 : random());
    (void)decode_pose(bytes, surface, static_cast<PoseCoding>(round % 3), &decoded);
    EXPECT_EQ(decoded.size(), s.pose.size());
  }
}

}  // namespace
}  // namespace anicodec
