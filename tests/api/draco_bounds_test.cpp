// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Streams that the encoder writes by Draco pass its guard and come back, and no stream that passes
// takes more of the heap than the limits announce.
#include "codec/connectivity/draco_encode.h"
#include "codec/connectivity/mesh_layout.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/mesh/draco_poses.h"
#include "tests/heap_count.h"
#include "tests/sdk/triangle_lists.h"

#include <algorithm>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Bitstream {
  std::string name;
  const MeshLayout* layout = nullptr;
  std::vector<Vector<int32_t>> poses;
  DracoPoses coded;
};

MeshLayout layout_of(const TriangleList& list) {
  MeshSequence s;
  s.vertex_count = list.vertex_count;
  s.frame_count = 1;
  for (uint32_t v = 0; v < list.vertex_count; ++v)
    s.positions.insert(s.positions.end(), {float(v), float(v % 71), float(v % 5)});
  for (size_t i = 0; i < list.triangles.size(); i += 3)
    s.polygons.add(std::vector<uint32_t>(list.triangles.begin() + static_cast<ptrdiff_t>(i),
                                         list.triangles.begin() + static_cast<ptrdiff_t>(i + 3)));
  return lay_out_mesh(s);
}

/// Triangles that touch each other nowhere, here and there, or everywhere.
TriangleList random_list(uint32_t triangles, uint32_t vertices, std::mt19937& random) {
  TriangleList list{"random", {}, vertices};
  for (uint32_t t = 0; t < triangles; ++t)
    list.add(random() % vertices, random() % vertices, random() % vertices);
  return list;
}

Bitstream with_poses(const MeshLayout& layout, uint32_t count, uint32_t size,
                     std::mt19937& random) {
  Bitstream result{std::to_string(count) + " poses of " + std::to_string(size), &layout, {}, {}};
  for (uint32_t j = 0; j < count; ++j) {
    Vector<int32_t>& pose = result.poses.emplace_back(size_t{3} * layout.sizes.coded_vertices);
    for (size_t i = 0; i < pose.size(); ++i)
      pose[i] = static_cast<int32_t>(i / 3 % 64 * (size / 64) + random() % size);
  }
  result.coded = encode_draco_poses(layout.topology, result.poses);
  return result;
}

/// Decodes; the heap keeps within what is announced.
Status tried(const Bitstream& stream, std::vector<std::vector<int32_t>>* poses) {
  Limits limits;
  limits.meshes.push_back(stream.layout->sizes);
  Limits::Segment& segment = limits.segments.emplace_back();
  segment.frames = segment.components = static_cast<uint32_t>(stream.poses.size());
  segment.draco_bytes = static_cast<uint32_t>(stream.coded.bytes.size());
  segment.draco_points = stream.coded.points;
  const auto announced = static_cast<size_t>(estimate_memory(limits, 1).draco);
  Memory memory;
  memory.allocate = [](void*, size_t size, size_t) -> void* {
    const HeapPause own;
    return std::malloc(size);
  };
  memory.release = [](void*, void* block, size_t) {
    const HeapPause own;
    std::free(block);
  };
  const MemoryScope scope(&memory);
  const HeapCount heap;
  Vector<Vector<int32_t>> decoded;
  const Status status = decode_draco_poses(stream.coded.bytes, stream.layout->topology,
                                           segment.draco_points, segment.components, &decoded);
  EXPECT_LE(heap.peak(), announced) << stream.name;
  const HeapPause own;
  for (const Vector<int32_t>& pose : decoded) {  // whose memory ends here
    if (poses)
      poses->emplace_back(pose.begin(), pose.end());
  }
  return status;
}

Status tried(const Bitstream& stream) {
  return tried(stream, nullptr);
}

std::vector<TriangleList> lists(std::mt19937& random) {
  std::vector<TriangleList> all = odd_triangle_lists();
  for (const uint32_t n : {3U, 20U, 40U, 90U})
    all.push_back(grid_list(n, n));
  for (const uint32_t triangles : {1U, 4U, 60U, 900U, 3000U}) {
    for (const uint32_t vertices : {triangles / 2 + 3, 3 * triangles, 40 * triangles})
      all.push_back(random_list(triangles, vertices, random));
  }
  return all;
}

TEST(SlowDracoBounds, LetThroughWhatTheEncoderWrites) {
  std::mt19937 random(5);
  size_t tried_count = 0;
  for (const TriangleList& list : lists(random)) {
    const MeshLayout layout = layout_of(list);
    if (layout.sizes.triangles == 0)
      continue;
    for (const uint32_t count : {1U, 2U, 5U, 70U}) {
      if (count == 70 && layout.sizes.triangles > 1000)
        continue;
      for (const uint32_t size : {1U, 7U, 1000U, 1U << 17, 1U << 21}) {
        const Bitstream stream = with_poses(layout, count, size, random);
        std::vector<std::vector<int32_t>> poses;
        ASSERT_EQ(tried(stream, &poses), Status::kOk)
            << list.name << " " << layout.sizes.triangles << " " << stream.name;
        ASSERT_EQ(poses.size(), stream.poses.size());
        for (size_t j = 0; j < poses.size(); ++j)
          ASSERT_TRUE(std::equal(poses[j].begin(), poses[j].end(), stream.poses[j].begin()));
        ++tried_count;
      }
    }
  }
  EXPECT_GT(tried_count, 250U);
}

TEST(DracoBounds, HoldForDamagedBitstreams) {
  std::mt19937 random(6);
  size_t refused = 0, all = 0;
  for (const uint32_t n : {6U, 30U}) {
    for (const uint32_t count : {1U, 3U}) {
      const MeshLayout layout = layout_of(grid_list(n, n));
      Bitstream stream = with_poses(layout, count, 200, random);
      const size_t step = 1 + stream.coded.bytes.size() / 150;
      for (size_t i = 0; i < stream.coded.bytes.size(); i += step) {
        const uint8_t old = stream.coded.bytes[i];
        for (const uint32_t value : {old ^ 1U, old ^ 0x80U, 0U, 0xFFU, uint32_t(random())}) {
          stream.coded.bytes[i] = static_cast<uint8_t>(value);
          refused += tried(stream) != Status::kOk;
          ++all;
        }
        stream.coded.bytes[i] = old;
      }
    }
  }
  EXPECT_GT(refused, all / 10);
}

TEST(DracoBounds, RefuseWhatTheEncoderNeverWrites) {
  std::mt19937 random(7);
  const MeshLayout layout = layout_of(grid_list(9, 9));
  const Bitstream good = with_poses(layout, 2, 200, random);
  ASSERT_EQ(tried(good), Status::kOk);
  // One decoder of two attributes, of three integers each, and how each of them is coded.
  const Bytes head{1, 2, 0, 5, 3, 0, 0, 4, 5, 3, 0, 1, 1, 1};
  ASSERT_GT(good.coded.bytes.size(), head.size() + 3);
  ASSERT_TRUE(std::equal(head.begin(), head.end(), good.coded.bytes.begin()));
  const size_t values = head.size();

  const struct {
    const char* what;
    size_t at;
    std::initializer_list<uint8_t> others;
  } cases[] = {{"decoders", 0, {0, 2}},
               {"attributes", 1, {0, 1, 3, 65}},
               {"type of attribute", 7, {0, 1, 2, 3}},
               {"type of number", 8, {1, 3, 6, 9, 11}},
               {"integers of an attribute", 9, {0, 1, 2, 4, 6}},
               {"normalised", 10, {1, 255}},
               {"number of an attribute", 11, {0, 2}},
               {"coder of the attribute", 12, {0, 2, 3}},
               {"prediction", values, {0, 2, 3, 5, 6, 0xFE}},
               {"transform", values + 1, {0, 2, 3, 0xFF}},
               {"uncompressed", values + 2, {0, 2}}};

  for (const auto& c : cases) {
    for (const uint8_t other : c.others) {
      Bitstream changed = good;
      changed.coded.bytes[c.at] = other;
      EXPECT_EQ(tried(changed), Status::kDraco) << c.what << " " << int{other};
    }
  }
}

TEST(DracoBounds, PointsOfAVertexHaveOneValue) {
  // Two triangles that touch in a vertex, which Draco knows as two points.
  TriangleList touching{"touching", {}, 5};
  touching.add(0, 1, 2);
  touching.add(0, 3, 4);
  const MeshLayout layout = layout_of(touching);
  std::mt19937 random(8);
  Bitstream stream = with_poses(layout, 1, 200, random);
  EXPECT_EQ(stream.coded.points, 6U);
  ASSERT_EQ(tried(stream), Status::kOk);
  TriangleList apart{"apart", {}, 6};
  apart.add(0, 1, 2);
  apart.add(3, 4, 5);
  const MeshLayout two = layout_of(apart);
  stream.coded = with_poses(two, 1, 200, random).coded;
  EXPECT_EQ(tried(stream), Status::kDraco);
  stream.coded.points = 5;
  EXPECT_EQ(tried(stream), Status::kRecord);
}

}  // namespace
}  // namespace anicodec
