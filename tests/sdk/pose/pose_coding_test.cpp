// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_coding.h"

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

void expect_round_trip(const Sample& s) {
  Bytes bytes = encode_pose(s.topology, s.pose);
  Vector<int32_t> decoded;
  PoseSurface surface;
  ASSERT_EQ(decode_pose(bytes, s.topology, &surface, &decoded), Status::kOk);
  EXPECT_EQ(decoded, s.pose);
}

TEST(PoseCoding, ASmoothSheetTakesFewBits) {
  Sample s = sheet(40);
  expect_round_trip(s);
  EXPECT_LT(encode_pose(s.topology, s.pose).size() * 8, 5U * s.topology.coded_vertices);
}

TEST(PoseCoding, AnyTrianglesAndPositionsComeBack) {
  for (unsigned seed = 0; seed < 20; ++seed)
    expect_round_trip(random_sample(1 + seed * 7, seed * 20, 1 << seed, seed));
  expect_round_trip(random_sample(60, 100, INT32_MAX, 7));
}

TEST(PoseCoding, ExtremeCoordinatesComeBack) {
  Sample s = sheet(6);
  for (size_t i = 0; i < s.pose.size(); ++i)
    s.pose[i] = i % 3 == 0 ? INT32_MIN : i % 2 == 0 ? INT32_MAX : 0;
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
  Sample s = sheet(12);
  Bytes bytes = encode_pose(s.topology, s.pose);
  Vector<int32_t> decoded;
  PoseSurface surface;
  for (size_t size = 0; size < bytes.size(); ++size) {
    Status status = decode_pose({bytes.data(), size}, s.topology, &surface, &decoded);
    // Without its last bytes it may be the stream of another pose.
    if (size + 8 < bytes.size()) {
      EXPECT_EQ(status, Status::kEntropy) << size;
    } else
      EXPECT_NE(decoded, s.pose) << size;
  }
  bytes.push_back(1);
  EXPECT_EQ(decode_pose(bytes, s.topology, &surface, &decoded), Status::kEntropy);
}

TEST(PoseCoding, ArbitraryBytesDoNoHarm) {
  Sample s = sheet(10);
  std::mt19937 random(5);
  Vector<int32_t> decoded;
  PoseSurface surface;
  for (int round = 0; round < 200; ++round) {
    Bytes bytes(random() % 600);
    for (uint8_t& b : bytes)
      b = static_cast<uint8_t>(round % 3 == 0 ? 255 : random());
    decode_pose(bytes, s.topology, &surface, &decoded);
    EXPECT_EQ(decoded.size(), s.pose.size());
  }
}

}  // namespace
}  // namespace anicodec
