// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// What the encoder writes by way of Draco passes its guard, and nothing that passes takes more of
// the heap than the limits announce.
#include "codec/connectivity/draco_encode.h"
#include "codec/connectivity/mesh_layout.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/mesh/draco_mesh.h"
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
  Limits::Mesh sizes;
  Bytes bytes;
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
  return lay_out_mesh(s, CoderId::kDraco);
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
  std::vector<Vector<int32_t>> poses(count);
  for (Vector<int32_t>& pose : poses) {
    pose.resize(size_t{3} * layout.sizes.coded_vertices);
    for (size_t i = 0; i < pose.size(); ++i)
      pose[i] = static_cast<int32_t>(i / 3 % 64 * (size / 64) + random() % size);
  }
  Bitstream result{std::to_string(count) + " poses of " + std::to_string(size), layout.sizes,
                   encode_with_poses(layout, poses)};
  result.sizes.draco_components = draco_components(count);
  result.sizes.draco_bytes = static_cast<uint32_t>(result.bytes.size());
  return result;
}

/// Decodes; the heap keeps within what is announced.
Status tried(const Bitstream& stream) {
  Limits limits;
  limits.meshes.push_back(stream.sizes);
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
  DracoMesh mesh;
  const Status status = decode_draco_mesh(stream.bytes, stream.sizes.points, stream.sizes.triangles,
                                          stream.sizes.draco_components, &mesh);
  EXPECT_LE(heap.peak(), announced) << stream.name;
  return status;
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
    if (layout.coder != CoderId::kDraco)
      continue;
    for (const uint32_t count : {0U, 1U, 2U, 5U, 70U}) {
      if (count == 70 && layout.sizes.triangles > 1000)
        continue;
      for (const uint32_t size : {1U, 7U, 1000U, 1U << 17, 1U << 21}) {
        const Bitstream stream = with_poses(layout, count, size, random);
        ASSERT_EQ(tried(stream), Status::kOk)
            << list.name << " " << layout.sizes.triangles << " " << stream.name;
        ++tried_count;
      }
    }
  }
  EXPECT_GT(tried_count, 300U);
}

TEST(DracoBounds, HoldForDamagedBitstreams) {
  std::mt19937 random(6);
  size_t refused = 0, all = 0;
  for (const uint32_t n : {6U, 30U}) {
    for (const uint32_t count : {1U, 3U}) {
      const MeshLayout layout = layout_of(grid_list(n, n));
      Bitstream stream = with_poses(layout, count, 200, random);
      const size_t step = 1 + stream.bytes.size() / 150;
      for (size_t i = 0; i < stream.bytes.size(); i += step) {
        const uint8_t old = stream.bytes[i];
        for (const uint32_t value : {old ^ 1U, old ^ 0x80U, 0U, 0xFFU, uint32_t(random())}) {
          stream.bytes[i] = static_cast<uint8_t>(value);
          refused += tried(stream) != Status::kOk;
          ++all;
        }
        stream.bytes[i] = old;
      }
    }
  }
  EXPECT_GT(refused, all / 10);
}

/// Bytes from which a description begins: of attributes, and of the coding of values.
size_t find(const Bytes& bytes, std::initializer_list<uint8_t> wanted) {
  const auto at = std::search(bytes.begin(), bytes.end(), wanted.begin(), wanted.end());
  return static_cast<size_t>(at - bytes.begin());
}

TEST(DracoBounds, RefuseWhatTheEncoderNeverWrites) {
  std::mt19937 random(7);
  const Bitstream good = with_poses(layout_of(grid_list(9, 9)), 2, 200, random);
  ASSERT_EQ(tried(good), Status::kOk);
  // Two attributes: connectivity, element, order; then one of three integers each, and their coder.
  const size_t head = find(good.bytes, {2, 0xFF, 0, 1, 0, 0, 0, 1, 0, 5, 3, 0, 0, 1, 1, 4, 5, 3});
  ASSERT_LT(head + 21, good.bytes.size());
  const size_t values = head + 21;

  const struct {
    const char* what;
    size_t at;
    std::initializer_list<uint8_t> others;
  } cases[] = {{"traversal", 11, {1, 3}},
               {"seams of an attribute", head + 5, {1}},
               {"order of the values", head + 6, {1, 2}},
               {"type of attribute", head + 15, {0, 1, 2, 3}},
               {"type of number", head + 16, {1, 3, 6, 9, 11}},
               {"normalised", head + 18, {1, 255}},
               {"coder of the attribute", head + 20, {0, 2, 3}},
               {"prediction", values, {0, 2, 3, 5, 6, 0xFE}},
               {"transform", values + 1, {0, 2, 3, 0xFF}},
               {"uncompressed", values + 2, {0, 2}}};

  for (const auto& c : cases) {
    for (const uint8_t other : c.others) {
      Bitstream changed = good;
      changed.bytes[c.at] = other;
      EXPECT_EQ(tried(changed), Status::kDraco) << c.what << " " << int{other};
    }
  }
}

}  // namespace
}  // namespace anicodec
