// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/pose_coding.h"

#include "sdk/pose/dependent_steps.h"
#include "sdk/pose/exact_pose.h"

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
Vector<int32_t> dependent(Vector<int32_t> pose) {
  for (size_t axis = 0; axis < 3; ++axis) {
    size_t state = 0;
    for (size_t i = axis; i < pose.size(); i += 3) {
      int32_t& x = pose[i];
      const int32_t parity = DependentSteps::parity(state), half = (x - parity) / 2;
      x = 2 * half + parity;
      state = DependentSteps::next(state, half);
    }
  }
  return pose;
}

constexpr PoseSteps kSteps[] = {PoseSteps::kAny, PoseSteps::kDependent};

/// The pose, or the nearest one of those steps.
Vector<int32_t> codable(PoseSteps steps, const Vector<int32_t>& pose) {
  return steps == PoseSteps::kDependent ? dependent(pose) : pose;
}

/// Partners without rhyme or reason.
PosePartners random_partners(uint32_t vertices, unsigned seed) {
  std::mt19937 random(seed);
  PosePartners partners;
  for (uint32_t v = 0; v < vertices; ++v) {
    const uint32_t kind = random() % 4;
    partners.partner.push_back(kind == 0   ? PosePartners::kNone
                               : kind == 1 ? v
                                           : static_cast<uint32_t>(random() % vertices));
    partners.flips.push_back(static_cast<uint8_t>(random() % 8));
  }
  return partners;
}

/// Two sheets, the second a copy of the first with its axes flipped, moved, and partners of it.
Sample two_sheets(uint32_t n, uint32_t flips, PosePartners* partners) {
  Sample s = sheet(n);
  const uint32_t count = s.topology.coded_vertices;
  const size_t corners = s.topology.triangles.size();
  for (size_t i = 0; i < corners; i += 3) {
    const uint32_t* t = s.topology.triangles.data() + i;
    const bool mirrored = (flips ^ flips >> 1 ^ flips >> 2) & 1;
    const uint32_t a = t[0] + count, b = t[mirrored ? 2 : 1] + count,
                   c = t[mirrored ? 1 : 2] + count;
    s.topology.triangles.insert(s.topology.triangles.end(), {a, b, c});
  }
  s.topology.coded_vertices = 2 * count;
  for (size_t i = 0; i < size_t{3} * count; ++i)
    s.pose.push_back((flips >> i % 3 & 1 ? -1 : 1) * s.pose[i] + 9000);
  partners->partner.assign(count, PosePartners::kNone);
  for (uint32_t v = 0; v < count; ++v)
    partners->partner.push_back(v);
  partners->flips.assign(size_t{2} * count, static_cast<uint8_t>(flips));
  return s;
}

void expect_round_trip(const Sample& s) {
  const CornerTable table(s.topology);
  const PosePartners partners = random_partners(s.topology.coded_vertices, 3);
  for (PoseSteps steps : kSteps) {
    const Vector<int32_t> pose = codable(steps, s.pose);
    const Bytes bytes = encode_pose(table, steps, pose);
    Vector<int32_t> decoded;
    ASSERT_EQ(decode_pose(bytes, table, steps, &decoded), Status::kOk);
    EXPECT_EQ(decoded, pose);
    const Bytes by_partners = encode_pose(table, steps, pose, &partners);
    ASSERT_EQ(decode_pose(by_partners, table, steps, &decoded), Status::kOk);
    EXPECT_EQ(decoded, pose);
  }
  for (const PosePartners* by : {static_cast<const PosePartners*>(nullptr), &partners}) {
    Vector<int32_t> exact;
    ASSERT_EQ(
        decode_pose(encode_exact_pose(table, s.pose, by), table, PoseSteps::kDependent, &exact),
        Status::kOk);
    EXPECT_EQ(exact, s.pose);
  }
  // Key-frames: later ones by earlier ones, the last one alone.
  Vector<Vector<int32_t>> poses(4, s.pose);
  for (size_t i = 0; i < s.pose.size(); ++i) {
    poses[1][i] = s.pose[i] / 2 + 5;
    poses[2][i] = static_cast<int32_t>(i) % 1000 - s.pose[i];
  }
  const Vector<uint32_t> parents{0, 1, 2, 0};
  const Bytes bytes = encode_poses(table, PoseSteps::kAny, poses, parents, &partners);
  Vector<Vector<int32_t>> decoded;
  ASSERT_EQ(decode_poses(bytes, table, PoseSteps::kAny, parents, &decoded), Status::kOk);
  EXPECT_EQ(decoded, poses);
}

TEST(PoseCoding, ASmoothSheetTakesFewBits) {
  Sample s = sheet(40);
  expect_round_trip(s);
  const CornerTable table(s.topology);
  EXPECT_LT(encode_pose(table, PoseSteps::kAny, s.pose).size() * 8, 6U * s.topology.coded_vertices);
}

TEST(PoseCoding, CoordinatesThatRepeatTakeLessThanHalfWhenExact) {
  // Blocks of any height on an uneven grid.
  Sample s = sheet(40);
  std::mt19937 random(4);
  std::vector<int32_t> at(41), height(11 * 11);
  for (int32_t& x : at)
    x = static_cast<int32_t>(random() % 9000);
  for (int32_t& z : height)
    z = static_cast<int32_t>(random() % 900);
  for (size_t v = 0; v < 41 * 41; ++v) {
    const size_t x = v % 41, y = v / 41;
    s.pose[3 * v] = at[x];
    s.pose[3 * v + 1] = at[40 - y];
    s.pose[3 * v + 2] = height[y / 4 * 11 + x / 4];
  }
  const CornerTable table(s.topology);
  EXPECT_LT(2 * encode_exact_pose(table, s.pose).size(),
            encode_pose(table, PoseSteps::kAny, s.pose).size());
}

TEST(PoseCoding, ACopyOfAPartTakesNextToNothingHoweverItIsFlipped) {
  for (uint32_t flips = 0; flips < 8; ++flips) {
    PosePartners partners;
    const Sample s = two_sheets(30, flips, &partners);
    const CornerTable table(s.topology);
    const size_t one =
        encode_pose(CornerTable(sheet(30).topology), PoseSteps::kAny, sheet(30).pose).size();
    const Bytes bytes = encode_pose(table, PoseSteps::kAny, s.pose, &partners);
    EXPECT_LT(bytes.size(), one + one / 6) << flips;
    Vector<int32_t> decoded;
    ASSERT_EQ(decode_pose(bytes, table, PoseSteps::kAny, &decoded), Status::kOk);
    EXPECT_EQ(decoded, s.pose);
  }
}

TEST(PoseCoding, ALaterMomentTakesAFractionOfAnEarlierOne) {
  const Sample s = sheet(40);
  const CornerTable table(s.topology);
  // Turned by 0.3, and bent a little.
  Vector<Vector<int32_t>> poses(2, s.pose);
  for (size_t v = 0; v < s.topology.coded_vertices; ++v) {
    const double x = s.pose[3 * v], y = s.pose[3 * v + 1], z = s.pose[3 * v + 2] + 1e-5 * x * x;
    poses[1][3 * v] = static_cast<int32_t>(std::lround(std::cos(0.3) * x - std::sin(0.3) * z));
    poses[1][3 * v + 1] = static_cast<int32_t>(std::lround(y));
    poses[1][3 * v + 2] = static_cast<int32_t>(std::lround(std::sin(0.3) * x + std::cos(0.3) * z));
  }
  const auto bytes = [&](uint32_t parent) {
    return encode_poses(table, PoseSteps::kAny, poses, {0, parent}).size();
  };
  EXPECT_LT(bytes(1), 0.8 * static_cast<double>(bytes(0)));
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
  const CornerTable table(s.topology);
  for (PoseSteps steps : kSteps) {
    const Vector<int32_t> pose = codable(steps, s.pose);
    Bytes bytes = encode_pose(table, steps, pose);
    Vector<int32_t> decoded;
    for (size_t size = 0; size < bytes.size(); ++size) {
      const Status status = decode_pose({bytes.data(), size}, table, steps, &decoded);
      EXPECT_EQ(status, Status::kEntropy) << size;
    }
    bytes.push_back(1);
    EXPECT_EQ(decode_pose(bytes, table, steps, &decoded), Status::kEntropy);
  }
}

TEST(PoseCoding, ArbitraryBytesDoNoHarm) {
  const Sample s = sheet(10);
  const CornerTable table(s.topology);
  std::mt19937 random(5);
  Vector<int32_t> decoded;
  for (int round = 0; round < 600; ++round) {
    Bytes bytes(random() % 600);
    for (uint8_t& b : bytes)
      b = static_cast<uint8_t>(round % 4 == 0 ? 255 : random());
    (void)decode_pose(bytes, table, kSteps[round % 2], &decoded);
    EXPECT_EQ(decoded.size(), s.pose.size());
    Vector<Vector<int32_t>> poses;
    (void)decode_poses(bytes, table, PoseSteps::kAny, {0, 1, 0, 2}, &poses);
    EXPECT_EQ(poses.size(), 4);
  }
}

}  // namespace
}  // namespace anicodec
