// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The cost of opening grows with the announced limits, not with products of them: crafted files of
// growing size (spec/14-security.md, section 2).
#include "codec/connectivity/mesh_layout.h"
#include "codec/sequence/mesh_sequence.h"
#include "sdk/mesh/plain_coding.h"
#include "tests/api/crafted_file.h"

#include <algorithm>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Seconds of the processor that opening takes: the least of some tries.
double seconds(const Bytes& file) {
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    Clip clip;
    const std::clock_t start = std::clock();
    EXPECT_EQ(clip.open(file).status, Status::kOk);
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

/// Time that more segments take, of a mesh of so many triangles.
double more_segments(uint32_t triangles, uint32_t components, bool own_pose) {
  double taken[2];
  for (const uint32_t more : {0U, 1U}) {
    CraftedFile file(3, triangles);
    for (uint32_t i = 0; i < 2 + 30 * more; ++i)
      file.add_segment(1, components, own_pose, false);
    taken[more] = seconds(file.write());
  }
  return taken[1] - taken[0];
}

TEST(Work, OfAPoseDoesNotGrowWithTheTriangles) {
  EXPECT_LT(more_segments(300000, 0, true), 3 * more_segments(100, 0, true) + 0.1);
}

TEST(Work, OfAnOrderDoesNotGrowWithTheTriangles) {
  EXPECT_LT(more_segments(300000, 1, false), 3 * more_segments(100, 1, false) + 0.1);
}

TEST(Work, OfFramesWithoutCorrectionsDoesNotGrowWithTheVertices) {
  double taken[2];
  for (const uint32_t more : {0U, 1U}) {
    CraftedFile file(300000, 0);
    file.add_segment(more ? 40000 : 1, 0, false, true);
    taken[more] = seconds(file.write());
  }
  EXPECT_LT(taken[1] - taken[0], 0.3);
}

/// Polygons over vertices that share few places.
struct HostileMesh {
  std::string name;
  std::vector<std::vector<uint32_t>> polygons;
  uint32_t vertices = 0;
  bool welded = false;  ///< all vertices are at one of three places
};

/// Meshes on which a step that looks around would look at everything.
std::vector<HostileMesh> hostile_meshes(uint32_t n) {
  HostileMesh fan{"a fan", {}, n + 2}, spokes{"triangles at one vertex", {}, 2 * n + 1},
      book{"triangles at one edge", {}, n + 2}, dust{"triangles apart", {}, 3 * n},
      ring{"one polygon", {{}}, n}, turned{"triangles that turn at random", {}, n / 2 + 3},
      copies{"copies of three vertices", {}, 3 * n, true};
  uint32_t random = 1;
  const auto next = [&](uint32_t below) {
    random = random * 1664525 + 1013904223;
    return static_cast<uint32_t>(uint64_t{random} * below >> 32);
  };
  for (uint32_t i = 0; i < n; ++i) {
    fan.polygons.push_back({0, i + 1, i + 2});
    spokes.polygons.push_back({0, 2 * i + 1, 2 * i + 2});
    book.polygons.push_back({i % 2, 1 - i % 2, i + 2});
    dust.polygons.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    copies.polygons.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    ring.polygons[0].push_back(i);
    const uint32_t a = next(turned.vertices - 2);
    turned.polygons.push_back({a, a + 1 + next(2) * (turned.vertices - a - 2), (a + 1) / 2 + 1});
  }
  std::erase_if(turned.polygons, [](const std::vector<uint32_t>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  return {fan, spokes, book, dust, ring, turned, copies};
}

/// Seconds of the processor that faces and the order of the vertices take.
struct MeshSeconds {
  double encode = 1e9, decode = 1e9;
};

MeshSeconds mesh_seconds(const HostileMesh& mesh) {
  MeshSequence clip;
  clip.vertex_count = mesh.vertices;
  clip.frame_count = 1;
  for (uint32_t v = 0; v < mesh.vertices; ++v) {
    const uint32_t place = mesh.welded ? v % 3 : v;
    clip.positions.insert(clip.positions.end(),
                          {static_cast<float>(place % 1000), static_cast<float>(place / 1000), 0});
  }
  for (const std::vector<uint32_t>& polygon : mesh.polygons)
    clip.polygons.add(polygon);
  MeshSeconds least;
  const auto seconds_since = [](std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  for (int i = 0; i < 2; ++i) {
    std::clock_t start = std::clock();
    const MeshLayout layout = lay_out_mesh(clip);
    least.encode = std::min(least.encode, seconds_since(start));
    start = std::clock();
    Topology topology;
    EXPECT_EQ(decode_faces(layout.faces, layout.sizes, &topology), Status::kOk) << mesh.name;
    Vector<uint32_t> source;
    EXPECT_EQ(decode_vertex_map(layout.vertex_map, topology, &source), Status::kOk) << mesh.name;
    least.decode = std::min(least.decode, seconds_since(start));
  }
  return least;
}

TEST(Work, OfFacesAndTheOrderOfVerticesGrowsWithTheCorners) {
  constexpr uint32_t kTriangles = 4000, kTimes = 8;
  constexpr double kSlack = 2.5;  // logarithms, and what no longer fits the caches
  const std::vector<HostileMesh> small = hostile_meshes(kTriangles),
                                 large = hostile_meshes(kTimes * kTriangles);
  for (size_t i = 0; i < small.size(); ++i) {
    const MeshSeconds one = mesh_seconds(small[i]), many = mesh_seconds(large[i]);
    EXPECT_LT(many.decode, kSlack * kTimes * one.decode + 0.05) << small[i].name;
    EXPECT_LT(many.encode, kSlack * kTimes * one.encode + 0.05) << small[i].name;
  }
}

TEST(Work, OfFramesWithCorrectionsIsLimited) {
  CraftedFile file(1 << 20, 0);
  file.add_segment(20000, 0, false, true);
  Bytes bytes = file.write();
  Clip clip;
  EXPECT_EQ(clip.open(bytes).status, Status::kOk);  // one frame in 20000
  Limits limits;
  ContainerReader reader;
  ASSERT_TRUE(reader.open(bytes).ok());
  ByteView view;
  ASSERT_TRUE(reader.payload(*reader.find("LIMI"), &view).ok());
  ASSERT_EQ(Limits::read(view, &limits), Status::kOk);
  limits.segments[0].corrections = 20000;
  ContainerWriter out;
  out.add("LIMI", true, kNoMesh, kNoSegment, limits.write());
  bytes = out.finish();
  EXPECT_EQ(clip.open(bytes).status, Status::kLimit);
}

}  // namespace
}  // namespace anicodec
