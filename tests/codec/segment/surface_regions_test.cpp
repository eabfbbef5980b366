// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/surface_regions.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

constexpr uint32_t kWidth = 40, kHeight = 12, kFrames = 30;

MeshGraph sheet_graph(uint32_t sheets = 1) {
  std::vector<uint32_t> triangles;
  for (uint32_t s = 0; s < sheets; ++s) {
    for (uint32_t y = 0; y + 1 < kHeight; ++y) {
      for (uint32_t x = 0; x + 1 < kWidth; ++x) {
        const uint32_t v = (s * kHeight + y) * kWidth + x;
        triangles.insert(triangles.end(),
                         {v, v + 1, v + kWidth, v + 1, v + kWidth + 1, v + kWidth});
      }
    }
  }
  MeshGraph graph;
  EXPECT_EQ(graph.init(triangles.data(), triangles.size() / 3, sheets * kWidth * kHeight),
            Status::kOk);
  return graph;
}

/// A sheet_graph whose columns below `border` wave in one way, the others in another one.
std::vector<float> waves(uint32_t border) {
  std::vector<float> positions;
  for (uint32_t f = 0; f < kFrames; ++f) {
    for (uint32_t v = 0; v < kWidth * kHeight; ++v) {
      const double x = v % kWidth, y = v / kWidth;
      const bool left = v % kWidth < border;
      double z = 0;
      for (int k = 1; k <= 6; ++k)  // of little in common
        z += std::sin(left ? 0.9 * k * y + 0.37 * k * k * f : 1.3 * k * y + 0.53 * k * k * f + 1);
      positions.insert(positions.end(),
                       {static_cast<float>(x), static_cast<float>(y), static_cast<float>(0.3 * z)});
    }
  }
  return positions;
}

TEST(SurfaceRegions, LieWhereTheMotionChanges) {
  const std::vector<float> positions = waves(14);
  const FrameView clip(positions.data(), kFrames, kWidth * kHeight);
  const Vector<uint8_t> regions = find_regions(clip, sheet_graph(), 2);
  uint32_t wrong = 0;
  for (uint32_t v = 0; v < regions.size(); ++v)
    wrong += (regions[v] == regions[0]) != (v % kWidth < 14);
  EXPECT_LT(wrong, kWidth * kHeight / 10);  // the larger region is dearer
}

TEST(SurfaceRegions, AreNeverSmall) {
  const std::vector<float> positions = waves(2);
  const FrameView clip(positions.data(), kFrames, kWidth * kHeight);
  for (uint32_t count : {2U, 4U, 8U}) {
    const Vector<uint8_t> regions = find_regions(clip, sheet_graph(), count);
    for (uint8_t r = 0; r < count; ++r)
      EXPECT_GE(std::ranges::count(regions, r), kWidth * kHeight / count / 4);
  }
}

TEST(SurfaceRegions, KeepSmallPiecesWhole) {
  // A sheet_graph, and pieces of a tenth of its size far away.
  constexpr uint32_t kPieces = 5, kSize = 20, kSheet = kWidth * kHeight;
  MeshGraph graph;
  std::vector<uint32_t> triangles;
  for (uint32_t y = 0; y + 1 < kHeight; ++y)
    for (uint32_t x = 0; x + 1 < kWidth; ++x)
      triangles.insert(triangles.end(), {y * kWidth + x, y * kWidth + x + 1, (y + 1) * kWidth + x});
  for (uint32_t p = 0; p < kPieces; ++p)
    for (uint32_t i = 0; i + 2 < kSize; ++i)
      for (uint32_t c = 0; c < 3; ++c)
        triangles.push_back(kSheet + p * kSize + i + c);
  const uint32_t n = kSheet + kPieces * kSize;
  ASSERT_EQ(graph.init(triangles.data(), triangles.size() / 3, n), Status::kOk);
  const std::vector<float> one = waves(20);
  std::vector<float> positions;
  for (uint32_t f = 0; f < kFrames; ++f) {
    positions.insert(positions.end(), one.begin() + 3 * kSheet * f,
                     one.begin() + 3 * kSheet * (f + 1));
    for (uint32_t i = 0; i < kPieces * kSize; ++i)
      positions.insert(positions.end(),
                       {static_cast<float>(100 + i % kSize), static_cast<float>(i / kSize),
                        static_cast<float>(std::sin(0.3 * f * (i / kSize)))});
  }
  const Vector<uint8_t> regions = find_regions({positions.data(), kFrames, n}, graph, 4);
  for (uint32_t p = 0; p < kPieces; ++p) {
    const auto first = regions.begin() + kSheet + p * kSize;
    EXPECT_EQ(std::set<uint8_t>(first, first + kSize).size(), 1u) << p;
  }
}

TEST(SurfaceRegions, DoNotDependOnThreads) {
  const std::vector<float> positions = waves(14);
  const FrameView clip(positions.data(), kFrames, kWidth * kHeight);
  const Vector<uint8_t> many = find_regions(clip, sheet_graph(), 4);
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(find_regions(clip, sheet_graph(), 4), many);
}

TEST(SurfaceRegions, AcceptAMeshWithoutEdgesThatDoesNotMove) {
  MeshGraph loose;
  ASSERT_EQ(loose.init(nullptr, 0, 50), Status::kOk);
  const std::vector<float> still(size_t{3} * 50 * 2, 1);
  for (uint8_t region : find_regions({still.data(), 2, 50}, loose, 3))
    EXPECT_LT(region, 3);
}

TEST(RegionClips, HaveThePositionsOfTheirVertices) {
  const std::vector<float> positions = waves(14);
  const FrameView clip(positions.data(), kFrames, kWidth * kHeight);
  Vector<uint8_t> regions(kWidth * kHeight);
  for (uint32_t v = 0; v < regions.size(); ++v)
    regions[v] = static_cast<uint8_t>(v % 3);
  const RegionClips clips(clip, regions, 3);
  ASSERT_EQ(clips.count(), 3u);
  for (uint32_t r = 0; r < 3; ++r) {
    const FrameView part = clips.clip(r);
    ASSERT_EQ(part.vertex_count, clips.vertices(r).size());
    for (uint32_t i = 0; i < part.vertex_count; ++i) {
      EXPECT_EQ(clips.vertices(r)[i], 3 * i + r);
      EXPECT_TRUE(std::equal(part.frame(7) + 3 * i, part.frame(7) + 3 * i + 3,
                             clip.frame(7) + 3 * (3 * i + r)));
    }
  }
}

}  // namespace
}  // namespace anicodec
