// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/mesh_layout.h"

#include "codec/connectivity/manifold_mesh.h"
#include "sdk/mesh/draco_mesh.h"
#include "sdk/mesh/plain_coding.h"

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

/// What a decoder rebuilds from the chunks of a layout.
Topology decoded(const MeshLayout& layout, bool vertices, bool faces) {
  Vector<uint32_t> triangles;
  if (layout.coder == CoderId::kDraco) {
    DracoMesh draco;
    EXPECT_EQ(decode_draco_mesh(layout.connectivity, layout.sizes.points, layout.sizes.triangles, 4,
                                &draco),
              Status::kOk);
    triangles = draco.triangles;
  } else {
    EXPECT_EQ(decode_plain_triangles(layout.connectivity, layout.sizes.triangles, &triangles),
              Status::kOk);
  }
  Topology topology;
  EXPECT_EQ(decode_details(layout.details, layout.sizes, triangles, &topology), Status::kOk);
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

void expect_round_trip(const MeshSequence& s, CoderId coder) {
  MeshLayout layout = lay_out_mesh(s, coder);
  if (layout.sizes.triangles > 0) {
    EXPECT_EQ(layout.coder, coder);
  }
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

class MeshLayoutOf : public testing::TestWithParam<CoderId> {};

TEST_P(MeshLayoutOf, RoundTripsGrids) {
  expect_round_trip(grid(9, false, 1), GetParam());
  expect_round_trip(grid(9, true, 2), GetParam());
}

TEST_P(MeshLayoutOf, RoundTripsOddMeshes) {
  expect_round_trip(mesh_of(1, {}), GetParam());
  expect_round_trip(mesh_of(5, {}), GetParam());
  expect_round_trip(mesh_of(3, {{0, 1, 2}}), GetParam());
  expect_round_trip(mesh_of(7, {{6, 3, 1}}), GetParam());                        // unused vertices
  expect_round_trip(mesh_of(4, {{0, 1, 2}, {2, 1, 0}, {0, 1, 2}}), GetParam());  // duplicates
  expect_round_trip(mesh_of(4, {{0, 0, 1}, {0, 1}, {2}, {}, {0, 1, 2}}), GetParam());
  expect_round_trip(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), GetParam());  // three at an edge
  expect_round_trip(mesh_of(5, {{0, 1, 2}, {0, 3, 4}}), GetParam());             // bow-tie
  expect_round_trip(mesh_of(8, {{0, 1, 2, 3, 4}, {4, 3, 5}, {5, 3, 2, 6}}), GetParam());
  expect_round_trip(mesh_of(6, {{0, 1, 2}, {3, 4, 5}}), GetParam());  // two components
}

TEST_P(MeshLayoutOf, RoundTripsWeldedMeshes) {
  expect_round_trip(mesh_of(6, {{0, 1, 2}, {3, 5, 4}}, {{1, 4}, {2, 5}}), GetParam());
  expect_round_trip(mesh_of(6, {{0, 1, 2}, {3, 4, 5}}, {{0, 3}, {1, 4}, {2, 5}}), GetParam());
  expect_round_trip(mesh_of(4, {{0, 1, 2, 3}}, {{0, 1}, {1, 2}, {2, 3}}), GetParam());
}

TEST_P(MeshLayoutOf, RoundTripsRandomPolygonSoups) {
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
    expect_round_trip(mesh_of(n, faces, equal), GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Coders, MeshLayoutOf, testing::Values(CoderId::kPlain, CoderId::kDraco));

TEST(MeshLayout, SplitsMakeEveryDirectedEdgeUnique) {
  MeshSequence s = mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  Weld weld = weld_trajectories(s);
  ManifoldMesh m = make_manifold(s.polygons, weld.welded);
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t c = 0; c < m.triangles.size(); ++c)
    edges.emplace_back(m.triangles[c], m.triangles[c % 3 == 2 ? c - 2 : c + 1]);
  std::sort(edges.begin(), edges.end());
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
  EXPECT_EQ(m.points, 9U);
}

TEST(MeshLayout, TruncatedDetailsAreRefused) {
  MeshLayout layout = lay_out_mesh(grid(6, true, 3), CoderId::kPlain);
  Vector<uint32_t> triangles;
  ASSERT_EQ(decode_plain_triangles(layout.connectivity, layout.sizes.triangles, &triangles),
            Status::kOk);
  for (size_t n = 0; n < layout.details.size(); ++n) {
    Bytes cut(layout.details.begin(), layout.details.begin() + n);
    Topology t;
    EXPECT_NE(decode_details(cut, layout.sizes, triangles, &t), Status::kOk) << n;
  }
}

}  // namespace
}  // namespace anicodec
