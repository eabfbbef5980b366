// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/exact_encode.h"

#include "sdk/exact/exact_positions.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr uint32_t kSheetSide = 9, kVertices = kSheetSide * kSheetSide;

Topology grid() {
  Topology topology;
  topology.coded_vertices = kVertices;
  for (uint32_t y = 0; y + 1 < kSheetSide; ++y) {
    for (uint32_t x = 0; x + 1 < kSheetSide; ++x) {
      const uint32_t a = y * kSheetSide + x;
      for (uint32_t v : {a, a + 1, a + kSheetSide, a + 1, a + kSheetSide + 1, a + kSheetSide})
        topology.triangles.push_back(v);
    }
  }
  return topology;
}

Status decode(const Bytes& bytes, const Topology& topology, uint32_t frames, Segment* segment) {
  Limits::Segment sizes;
  sizes.frames = segment->frames = frames;
  Limits::Mesh mesh;
  mesh.coded_vertices = topology.coded_vertices;
  SegmentContext context;
  context.sizes = &sizes;
  context.mesh_sizes = &mesh;
  context.topology = &topology;
  return open_exact_positions(bytes, context, segment);
}

/// Encodes and decodes frames of the grid; returns how many bytes they took.
size_t expect_same(const std::vector<float>& positions) {
  const Topology topology = grid();
  const auto frames = static_cast<uint32_t>(positions.size() / 3 / kVertices);
  const Bytes bytes = encode_exact({positions.data(), frames, kVertices}, topology);
  Segment segment;
  EXPECT_EQ(decode(bytes, topology, frames, &segment), Status::kOk);
  EXPECT_EQ(segment.exact.size(), positions.size());
  EXPECT_EQ(std::memcmp(segment.exact.data(), positions.data(), 4 * positions.size()), 0);
  EXPECT_EQ(segment.stored_exact_hash, segment.decoded_exact_hash);
  return bytes.size();
}

/// A sheet_frames that waves, rounded by `round`.
template <class Round>
std::vector<float> sheet_frames(uint32_t frames, Round round) {
  std::vector<float> positions;
  for (uint32_t f = 0; f < frames; ++f) {
    for (uint32_t v = 0; v < kVertices; ++v) {
      const double x = v % kSheetSide, y = static_cast<double>(v / kSheetSide);
      for (double c : {x, y + 0.1 * std::sin(0.2 * f), std::sin(0.5 * x + 0.3 * y + 0.1 * f)})
        positions.push_back(static_cast<float>(round(c)));
    }
  }
  return positions;
}

TEST(ExactEncode, GivesBackAnyNumbersBitForBit) {
  std::mt19937 random(3);
  std::vector<float> positions;
  while (positions.size() < size_t{3} * kVertices * 7) {
    const uint32_t bits = static_cast<uint32_t>(random());
    float x;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x))
      positions.push_back(x);
  }
  EXPECT_LT(static_cast<double>(expect_same(positions)),
            4.5 * static_cast<double>(positions.size()));
}

TEST(ExactEncode, GivesBackZerosOfBothSignsAndTheEndsOfTheRange) {
  using Float = std::numeric_limits<float>;
  const float values[] = {
      0.0F,         -0.0F,         Float::max(), -Float::max(), Float::denorm_min(),
      Float::min(), -Float::min(), 1.0F,         -1.0F};
  std::mt19937 random(4);
  std::vector<float> positions;
  for (size_t i = 0; i < size_t{3} * kVertices * 5; ++i)
    positions.push_back(values[random() % std::size(values)]);
  expect_same(positions);
  expect_same(std::vector<float>(size_t{3} * kVertices * 4, -0.0F));
}

TEST(ExactEncode, TakesLittleForMotionThatIsSmoothAndLessOnALattice) {
  const size_t plain = expect_same(sheet_frames(40, [](double x) { return x; }));
  const size_t decimals =
      expect_same(sheet_frames(40, [](double x) { return std::round(x * 1e3) / 1e3; }));
  EXPECT_LT(plain, 12 * kVertices * 40 / 2);
  EXPECT_LT(decimals, plain / 2);
}

TEST(ExactEncode, FramesThatCameBeforeTakeNextToNothing) {
  std::vector<float> once = sheet_frames(10, [](double x) { return x; });
  const size_t bytes = expect_same(once);
  std::vector<float> thrice = once;
  for (int i = 0; i < 2; ++i)
    thrice.insert(thrice.end(), once.begin(), once.end());
  EXPECT_LT(expect_same(thrice), bytes + 200);
}

TEST(ExactEncode, OneFrameAndOneVertex) {
  expect_same(sheet_frames(1, [](double x) { return x; }));
  Topology point;
  point.coded_vertices = 1;
  const std::vector<float> positions = {1, 2, 3, -0.0F, 2, 3.5F};
  const Bytes bytes = encode_exact({positions.data(), 2, 1}, point);
  Segment segment;
  ASSERT_EQ(decode(bytes, point, 2, &segment), Status::kOk);
  EXPECT_EQ(std::memcmp(segment.exact.data(), positions.data(), 4 * positions.size()), 0);
}

TEST(ExactEncode, ADecoderRefusesWhatNoEncoderWrites) {
  const Topology topology = grid();
  const std::vector<float> positions =
      sheet_frames(6, [](double x) { return std::round(x * 1e3) / 1e3; });
  const Bytes good = encode_exact({positions.data(), 6, kVertices}, topology);
  Segment segment;
  Bytes bytes = good;
  bytes.push_back(1);
  EXPECT_EQ(decode(bytes, topology, 6, &segment), Status::kEntropy);
  bytes = good;
  bytes.resize(bytes.size() - 30);
  EXPECT_EQ(decode(bytes, topology, 6, &segment), Status::kEntropy);
  std::mt19937 random(9);
  for (int i = 0; i < 300; ++i) {
    bytes = good;
    bytes[random() % bytes.size()] ^= static_cast<uint8_t>(1 + random() % 255);
    if (decode(bytes, topology, 6, &segment) == Status::kOk) {
      for (float x : segment.exact)
        ASSERT_TRUE(std::isfinite(x));
    }
  }
}

}  // namespace
}  // namespace anicodec
