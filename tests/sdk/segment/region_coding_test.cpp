// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/region_coding.h"

#include "tests/random.h"

#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr uint32_t kSide = 30;

MeshGraph sheet() {
  std::vector<uint32_t> triangles;
  for (uint32_t y = 0; y + 1 < kSide; ++y) {
    for (uint32_t x = 0; x + 1 < kSide; ++x) {
      const uint32_t v = y * kSide + x;
      triangles.insert(triangles.end(), {v, v + 1, v + kSide, v + 1, v + kSide + 1, v + kSide});
    }
  }
  MeshGraph graph;
  EXPECT_EQ(graph.init(triangles.data(), triangles.size() / 3, kSide * kSide), Status::kOk);
  return graph;
}

size_t coded_bytes(const MeshGraph& graph, uint32_t count, const Vector<uint8_t>& regions) {
  BinaryEncoder encoder;
  Vector<uint8_t> copy = regions;
  EXPECT_TRUE(RegionCoding(graph, count).code(encoder, &copy));
  EXPECT_EQ(copy, regions);
  const Bytes bytes = encoder.finish();
  BinaryDecoder decoder(bytes.data(), bytes.size());
  Vector<uint8_t> decoded(regions.size(), 99);
  EXPECT_TRUE(RegionCoding(graph, count).code(decoder, &decoded));
  EXPECT_TRUE(decoder.finish());
  EXPECT_EQ(decoded, regions);
  return bytes.size();
}

TEST(RegionCoding, GivesBackWhatWasCoded) {
  const MeshGraph graph = sheet();
  for (uint32_t count = 2; count <= kMaxRegions; ++count) {
    SmallRandom random(count);
    Vector<uint8_t> scattered(kSide * kSide), last(kSide * kSide, static_cast<uint8_t>(count - 1));
    for (uint8_t& region : scattered)
      region = static_cast<uint8_t>((random.bits() >> 8) % count);
    coded_bytes(graph, count, scattered);
    coded_bytes(graph, count, last);
  }
}

TEST(RegionCoding, TakesLittleWhereBordersAreShort) {
  Vector<uint8_t> quarters(kSide * kSide);
  for (uint32_t v = 0; v < quarters.size(); ++v)
    quarters[v] = static_cast<uint8_t>(v % kSide / 15 + v / kSide / 15 * 2);
  EXPECT_LT(coded_bytes(sheet(), 4, quarters), 30u);
}

TEST(RegionCoding, DoesWithoutEdges) {
  MeshGraph loose;
  ASSERT_EQ(loose.init(nullptr, 0, 50), Status::kOk);
  Vector<uint8_t> regions(50, 1);
  regions[0] = regions[17] = 2;
  EXPECT_LT(coded_bytes(loose, 3, regions), 20u);
}

TEST(RegionCoding, SaysWhenTheStreamRanOut) {
  const Bytes nothing(3, 0x5a);
  BinaryDecoder decoder(nothing.data(), nothing.size());
  Vector<uint8_t> regions(kSide * kSide);
  EXPECT_FALSE(RegionCoding(sheet(), 5).code(decoder, &regions) && decoder.finish());
}

}  // namespace
}  // namespace anicodec
