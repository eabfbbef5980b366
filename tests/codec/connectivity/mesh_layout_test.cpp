// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/mesh_layout.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using testing::ElementsAreArray;

using Faces = std::vector<std::vector<uint32_t>>;

/// A sequence of one frame in which every vertex is somewhere else, except those named equal.
MeshSequence mesh_of(uint32_t vertices, const Faces& faces,
                     const std::vector<std::pair<uint32_t, uint32_t>>& equal = {}) {
  MeshSequence s;
  s.vertex_count = vertices;
  s.frame_count = 1;
  for (uint32_t v = 0; v < vertices; ++v)
    s.positions.insert(s.positions.end(), {float(v), float(v * v % 17), float(v % 5)});
  for (auto [a, b] : equal)
    std::copy_n(s.positions.begin() + 3 * a, 3, s.positions.begin() + 3 * b);
  for (const auto& f : faces)
    s.polygons.add(f);
  return s;
}

/// A grid of quads or triangles, its vertices renumbered at random.
MeshSequence grid(uint32_t n, bool quads, unsigned seed) {
  std::vector<uint32_t> id((n + 1) * (n + 1));
  std::iota(id.begin(), id.end(), 0U);
  std::shuffle(id.begin(), id.end(), std::mt19937(seed));
  Faces faces;
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      uint32_t a = id[y * (n + 1) + x], b = id[y * (n + 1) + x + 1],
               c = id[(y + 1) * (n + 1) + x + 1], d = id[(y + 1) * (n + 1) + x];
      if (quads)
        faces.push_back({a, b, c, d});
      else
        faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
    }
  }
  return mesh_of(static_cast<uint32_t>(id.size()), faces);
}

/// The topology that a decoder rebuilds from the chunks of a layout.
Topology decoded(const MeshLayout& layout, bool vertices, bool faces) {
  Topology topology;
  EXPECT_EQ(decode_faces(layout.faces, layout.sizes, &topology), Status::kOk);
  Vector<uint32_t> map;
  if (vertices) {
    EXPECT_EQ(decode_vertex_map(layout.vertex_map, topology, &map), Status::kOk);
  }
  if (faces) {
    Vector<uint32_t> place, first;
    EXPECT_EQ(decode_face_map(layout.face_map, topology, &place, &first), Status::kOk);
    apply_face_map(place, first, &topology);
  }
  if (vertices)
    apply_vertex_map(map, &topology);
  return topology;
}

/// Polygons as sorted list of corner cycles, each rotated to start at its smallest corner.
template <class Numbers>
Faces cycles(const Numbers& offsets, const Numbers& corners) {
  Faces faces;
  for (size_t p = 0; p + 1 < offsets.size(); ++p) {
    std::vector<uint32_t> f(corners.begin() + offsets[p], corners.begin() + offsets[p + 1]);
    if (!f.empty())
      std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    faces.push_back(f);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

void expect_round_trip(const MeshSequence& s) {
  const MeshLayout layout = lay_out_mesh(s);
  Topology t = decoded(layout, true, false);
  ASSERT_EQ(t.vertex_coded.size(), s.vertex_count);
  EXPECT_THAT(t.vertex_coded, ElementsAreArray(layout.source_coded));
  EXPECT_EQ(cycles(t.polygon_offsets, t.polygon_corners),
            cycles(s.polygons.offsets, s.polygons.corners));
  Topology all = decoded(layout, true, true);
  EXPECT_THAT(all.polygon_offsets, ElementsAreArray(s.polygons.offsets));
  EXPECT_THAT(all.polygon_corners, ElementsAreArray(s.polygons.corners));
  Topology free = decoded(layout, false, false);
  EXPECT_TRUE(std::is_sorted(free.vertex_coded.begin(), free.vertex_coded.end()));
}

TEST(MeshLayout, RoundTripsGrids) {
  expect_round_trip(grid(9, false, 1));
  expect_round_trip(grid(9, true, 2));
}

TEST(MeshLayout, RoundTripsOddMeshes) {
  expect_round_trip(mesh_of(1, {}));
  expect_round_trip(mesh_of(5, {}));
  expect_round_trip(mesh_of(3, {{0, 1, 2}}));
  expect_round_trip(mesh_of(7, {{6, 3, 1}}));                        // unused vertices
  expect_round_trip(mesh_of(4, {{0, 1, 2}, {2, 1, 0}, {0, 1, 2}}));  // duplicates
  expect_round_trip(mesh_of(4, {{0, 0, 1}, {0, 1}, {2}, {}, {0, 1, 2}}));
  expect_round_trip(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));  // three at an edge
  expect_round_trip(mesh_of(5, {{0, 1, 2}, {0, 3, 4}}));             // bow-tie
  expect_round_trip(mesh_of(8, {{0, 1, 2, 3, 4}, {4, 3, 5}, {5, 3, 2, 6}}));
  expect_round_trip(mesh_of(6, {{0, 1, 2}, {3, 4, 5}}));  // two components
}

TEST(MeshLayout, RoundTripsWeldedMeshes) {
  expect_round_trip(mesh_of(6, {{0, 1, 2}, {3, 5, 4}}, {{1, 4}, {2, 5}}));
  expect_round_trip(mesh_of(6, {{0, 1, 2}, {3, 4, 5}}, {{0, 3}, {1, 4}, {2, 5}}));
  expect_round_trip(mesh_of(4, {{0, 1, 2, 3}}, {{0, 1}, {1, 2}, {2, 3}}));
}

TEST(MeshLayout, RoundTripsRandomPolygonSoups) {
  std::mt19937 random(7);
  for (int run = 0; run < 60; ++run) {
    uint32_t n = 4 + random() % 20;
    Faces faces;
    for (uint32_t f = 0, count = random() % 30; f < count; ++f) {
      std::vector<uint32_t>& face = faces.emplace_back();
      for (uint32_t i = 0, corners = 2 + random() % 5; i < corners; ++i)
        face.push_back(random() % n);
    }
    std::vector<std::pair<uint32_t, uint32_t>> equal;
    for (uint32_t i = 0, count = random() % 5; i < count; ++i)
      equal.emplace_back(random() % n, random() % n);
    expect_round_trip(mesh_of(n, faces, equal));
  }
}

TEST(MeshLayout, RoundTripsCopies) {
  // A grid of quads whose seams run along every third row and column, and everywhere.
  for (const uint32_t every : {1U, 3U}) {
    MeshSequence s;
    constexpr uint32_t kSide = 9;
    std::vector<std::vector<float>> places;
    std::vector<uint32_t> number((kSide + 1) * (kSide + 1) * 4, UINT32_MAX);
    for (uint32_t y = 0; y < kSide; ++y) {
      for (uint32_t x = 0; x < kSide; ++x) {
        std::vector<uint32_t> face;
        for (const auto& [dx, dy] : {std::pair(0U, 0U), {1U, 0U}, {1U, 1U}, {0U, 1U}}) {
          const bool along = (x + dx) % every == 0, up = (y + dy) % every == 0;
          const uint32_t copy = (along && dx ? 1 : 0) + (up && dy ? 2 : 0);
          uint32_t& v = number[4 * ((y + dy) * (kSide + 1) + x + dx) + copy];
          if (v == UINT32_MAX) {
            v = s.vertex_count++;
            s.positions.insert(s.positions.end(), {float(x + dx), float(y + dy), 0});
          }
          face.push_back(v);
        }
        s.polygons.add(face);
      }
    }
    s.frame_count = 1;
    expect_round_trip(s);
  }
}

TEST(MeshLayout, RoundTripsRepeatsWithOtherCopies) {
  expect_round_trip(mesh_of(4, {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}));
  expect_round_trip(
      mesh_of(6, {{0, 1, 2}, {3, 4, 5}, {0, 4, 2}, {5, 3, 4}}, {{0, 3}, {1, 4}, {2, 5}}));
  // Copies that no face uses, of vertices that some do, and that none does.
  expect_round_trip(mesh_of(9, {{0, 1, 2}, {2, 1, 3}}, {{1, 4}, {1, 5}, {6, 7}, {6, 8}}));
}

TEST(MeshLayout, TakesFacesOfManyCornersAsTheyAre) {
  std::vector<uint32_t> all(3000);
  std::iota(all.begin(), all.end(), 0U);
  const MeshSequence s = mesh_of(3000, {all, {5, 4, 3}});
  expect_round_trip(s);
  EXPECT_EQ(lay_out_mesh(s).sizes.triangles, 2999U);
}

TEST(MeshLayout, ManyGatesAtOneVertexTakeLinearTime) {
  // Triangles that share a vertex and no side, and some that share a side: quadratic time would show.
  constexpr uint32_t kCount = 40000;
  Faces faces;
  for (uint32_t i = 0; i < kCount; ++i) {
    faces.push_back({0, 2 * i + 1, 2 * i + 2});
    if (i % 4 == 0)
      faces.push_back({0, 1, 2 * i + 3});
  }
  expect_round_trip(mesh_of(2 * kCount + 4, faces));
}

TEST(MeshLayout, RegularFacesTakeNextToNothing) {
  EXPECT_LT(lay_out_mesh(grid(64, true, 4)).faces.size(), 40U);
  EXPECT_LT(lay_out_mesh(grid(64, false, 5)).faces.size(), 40U);
}

TEST(MeshLayout, DecodesTheExampleOfTheSpecification) {
  Limits::Mesh sizes;
  sizes.source_vertices = 7;
  sizes.coded_vertices = 6;
  sizes.triangles = 4;
  sizes.polygons = 3;
  sizes.corners = 12;
  Topology t;
  ASSERT_EQ(decode_faces(Bytes{0x9e, 0x9d}, sizes, &t), Status::kOk);
  EXPECT_THAT(t.polygon_corners, testing::ElementsAre(0, 1, 2, 4, 0, 1, 2, 4, 3, 1, 5, 6));
  EXPECT_THAT(t.vertex_coded, testing::ElementsAre(0, 1, 2, 2, 3, 4, 5));
  --sizes.triangles;
  EXPECT_EQ(decode_faces(Bytes{0x9e, 0x9d}, sizes, &t), Status::kTopology);
}

TEST(MeshLayout, TruncatedFacesAreRefused) {
  const MeshLayout layout = lay_out_mesh(grid(6, true, 3));
  for (size_t n = 0; n < layout.faces.size(); ++n) {
    Bytes cut(layout.faces.begin(), layout.faces.begin() + static_cast<ptrdiff_t>(n));
    Topology t;
    EXPECT_NE(decode_faces(cut, layout.sizes, &t), Status::kOk) << n;
  }
}

}  // namespace
}  // namespace anicodec
