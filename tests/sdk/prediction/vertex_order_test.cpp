// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/prediction/vertex_order.h"

#include "sdk/prediction/vertex_order_cost.h"
#include "tests/random.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Mesh {
  std::vector<uint32_t> triangles;
  std::vector<int32_t> positions;

  size_t vertex_count() const { return positions.size() / 3; }

  uint32_t add(int32_t x, int32_t y, int32_t z) {
    positions.insert(positions.end(), {x, y, z});
    return static_cast<uint32_t>(vertex_count() - 1);
  }

  void face(uint32_t a, uint32_t b, uint32_t c) { triangles.insert(triangles.end(), {a, b, c}); }
};

/// A wavy sheet of width x height vertices.
Mesh sheet(uint32_t width, uint32_t height, uint32_t seed = 1) {
  Mesh m;
  SmallRandom random(seed);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      m.add(static_cast<int32_t>(100 * x), static_cast<int32_t>(100 * y),
            static_cast<int32_t>(random.bits() >> 25));
  for (uint32_t y = 0; y + 1 < height; ++y)
    for (uint32_t x = 0; x + 1 < width; ++x) {
      const uint32_t v = y * width + x;
      m.face(v, v + 1, v + width);
      m.face(v + 1, v + width + 1, v + width);
    }
  return m;
}

VertexOrder order_of(const Mesh& mesh, int m = 16, int colours = 1) {
  VertexOrder o;
  EXPECT_EQ(make_vertex_order(mesh.triangles.data(), mesh.triangles.size() / 3,
                              mesh.positions.data(), mesh.vertex_count(), m, colours, &o),
            Status::kOk);
  return o;
}

/// The promises of every order, whatever the graph.
void expect_valid(const Mesh& mesh, const VertexOrder& o) {
  const size_t n = mesh.vertex_count();
  const auto m = static_cast<size_t>(o.neighbour_count);
  ASSERT_EQ(o.order.size(), n);
  Vector<uint32_t> sorted = o.order;
  std::sort(sorted.begin(), sorted.end());
  for (uint32_t v = 0; v < n; ++v)
    ASSERT_EQ(sorted[v], v);
  ASSERT_EQ(o.neighbours.size(), n * m);
  ASSERT_EQ(o.level_start.front(), 0u);
  ASSERT_EQ(o.level_start.back(), n);
  const auto distance = [&](size_t a, size_t b) {
    int64_t sum = 0;
    for (size_t d = 0; d < 3; ++d) {
      const int64_t e =
          int64_t{mesh.positions[3 * o.order[a] + d]} - mesh.positions[3 * o.order[b] + d];
      sum += e * e;
    }
    return sum;
  };
  for (size_t l = 0; l < o.level_count(); ++l) {
    ASSERT_LT(o.level_start[l], o.level_start[l + 1]);
    for (size_t r = o.level_start[l]; r < o.level_start[l + 1]; ++r) {
      std::set<int32_t> seen;
      for (size_t a = 0; a < m; ++a) {
        const int32_t b = o.neighbours[r * m + a];
        if (b < 0) {
          ASSERT_TRUE(a > 0 || r == 0) << "only the first vertex has no neighbour";
          for (size_t e = a; e < m; ++e)
            ASSERT_EQ(o.neighbours[r * m + e], -1);
          break;
        }
        ASSERT_LT(b, static_cast<int32_t>(o.level_start[l])) << "a neighbour from an earlier level";
        ASSERT_TRUE(seen.insert(b).second);
        if (a > 0) {
          // Exact only where the coordinates fit the grid of the order.
          ASSERT_LE(distance(r, static_cast<size_t>(o.neighbours[r * m + a - 1])),
                    distance(r, static_cast<size_t>(b)));
        }
      }
    }
  }
}

/// An order that keeps regions apart.
VertexOrder order_of(const Mesh& mesh, const std::vector<uint8_t>& regions) {
  MeshGraph graph;
  VertexOrder o;
  EXPECT_EQ(graph.init(mesh.triangles.data(), mesh.triangles.size() / 3, mesh.vertex_count()),
            Status::kOk);
  EXPECT_EQ(make_vertex_order(graph, mesh.positions.data(), 16, 1, &o, regions.data()),
            Status::kOk);
  return o;
}

/// Ranks whose vertices have no neighbours: the first of each region.
size_t expect_apart(const VertexOrder& o, const std::vector<uint8_t>& regions) {
  Vector<uint32_t> sorted = o.order;
  std::sort(sorted.begin(), sorted.end());
  for (uint32_t v = 0; v < sorted.size(); ++v)
    EXPECT_EQ(sorted[v], v);
  size_t alone = 0;
  for (size_t l = 0; l < o.level_count(); ++l) {
    for (size_t r = o.level_start[l]; r < o.level_start[l + 1]; ++r) {
      alone += o.neighbours[r * 16] < 0;
      for (size_t a = 0; a < 16; ++a) {
        const int32_t b = o.neighbours[r * 16 + a];
        if (b < 0)
          continue;
        EXPECT_LT(b, static_cast<int32_t>(o.level_start[l]));
        EXPECT_EQ(regions[o.order[static_cast<size_t>(b)]], regions[o.order[r]]);
      }
    }
  }
  return alone;
}

/// Visits of vertices and edges while an order is made, for each vertex and corner of the mesh.
double visits_of(const Mesh& mesh, int colours) {
  VertexOrder o;
  uint64_t visits = 0;
  EXPECT_EQ(make_counted_vertex_order(mesh.triangles.data(), mesh.triangles.size() / 3,
                                      mesh.positions.data(), mesh.vertex_count(), 24, colours, &o,
                                      &visits),
            Status::kOk);
  expect_valid(mesh, o);
  return static_cast<double>(visits) /
         static_cast<double>(mesh.vertex_count() + mesh.triangles.size());
}

TEST(VertexOrder, KeepsRegionsApart) {
  const Mesh mesh = sheet(40, 30);
  const size_t n = mesh.vertex_count();
  std::vector<uint8_t> halves(n), eight(n), scattered(n), lone(n, 5), one(n, 3);
  SmallRandom random(7);
  for (size_t v = 0; v < n; ++v) {
    halves[v] = v % 40 < 20;
    eight[v] = static_cast<uint8_t>(v % 40 / 10 + v / 600 * 4);
    scattered[v] = static_cast<uint8_t>(random.bits() >> 29);
  }
  lone[611] = 2;
  EXPECT_EQ(expect_apart(order_of(mesh, halves), halves), 2u);
  EXPECT_EQ(expect_apart(order_of(mesh, eight), eight), 8u);
  EXPECT_EQ(expect_apart(order_of(mesh, scattered), scattered), 8u);
  EXPECT_EQ(expect_apart(order_of(mesh, lone), lone), 2u);
  const VertexOrder whole = order_of(mesh), same = order_of(mesh, one);
  EXPECT_EQ(whole.order, same.order);
  EXPECT_EQ(whole.neighbours, same.neighbours);
}

TEST(VertexOrder, KeepsRegionsOfDenseAndLooseMeshesApart) {
  Mesh dense, loose;
  for (uint32_t v = 0; v < 60; ++v) {
    dense.add(static_cast<int32_t>(v * v), static_cast<int32_t>(37 * v % 60), 0);
    loose.add(static_cast<int32_t>(v), static_cast<int32_t>(v % 7), 5);
  }
  for (uint32_t a = 0; a < 60; ++a)
    for (uint32_t b = a + 1; b + 1 < 60; ++b)
      dense.face(a, b, b + 1);
  std::vector<uint8_t> regions(60);
  for (size_t v = 0; v < 60; ++v)
    regions[v] = v < 57 ? v % 2 : static_cast<uint8_t>(v - 55);
  EXPECT_EQ(expect_apart(order_of(dense, regions), regions), 5u);
  EXPECT_EQ(expect_apart(order_of(loose, regions), regions), 5u);
}

TEST(VertexOrder, IsAPermutationInWhichNeighboursComeFirst) {
  for (const int colours : {1, 2, 4}) {
    for (const int m : {1, 8, 16, 24}) {
      const Mesh mesh = sheet(40, 30);
      expect_valid(mesh, order_of(mesh, m, colours));
    }
  }
}

TEST(VertexOrder, GivesNearlyAllVerticesOfASheetAllNeighbours) {
  const VertexOrder o = order_of(sheet(40, 30));
  const auto missing = std::count(o.neighbours.begin(), o.neighbours.end(), -1);
  EXPECT_LT(missing, 16 * 24);
}

TEST(VertexOrder, HasLevelsThatGrowGeometrically) {
  const VertexOrder o = order_of(sheet(100, 100));
  EXPECT_LT(o.level_count(), 40u);
  const size_t last = o.level_start[o.level_count()] - o.level_start[o.level_count() - 1];
  EXPECT_GT(last, 100u * 100 / 5);
}

TEST(VertexOrder, AcceptsNoVertexOneVertexAndNoTriangle) {
  Mesh mesh;
  expect_valid(sheet(1, 1), order_of(sheet(1, 1)));
  for (int i = 0; i < 50; ++i)
    mesh.add(i * 7 % 11, i * 5 % 13, i);
  expect_valid(mesh, order_of(mesh));
  VertexOrder o;
  EXPECT_EQ(make_vertex_order(nullptr, 0, nullptr, 0, 16, 1, &o), Status::kOk);
  EXPECT_EQ(o.level_count(), 0u);
  EXPECT_TRUE(o.neighbours.empty());
}

TEST(VertexOrder, LinksComponentsAndIsolatedVertices) {
  Mesh mesh = sheet(20, 20);
  for (int i = 0; i < 30; ++i) {
    const uint32_t v = mesh.add(5000 + 10 * i, 0, 0);
    mesh.add(5000 + 10 * i, 3000, 0);  // isolated
    mesh.add(5000 + 10 * i, 0, 5);
    mesh.add(5000 + 10 * i, 5, 0);
    mesh.face(v, v + 2, v + 3);
  }
  for (const int colours : {1, 2})
    expect_valid(mesh, order_of(mesh, 16, colours));
}

TEST(VertexOrder, IgnoresDegenerateAndDuplicateTriangles) {
  const Mesh clean = sheet(12, 9);
  Mesh mesh = clean;
  mesh.face(3, 3, 3);
  mesh.face(0, 0, 1);
  mesh.face(1, 0, 12);
  const VertexOrder a = order_of(clean), b = order_of(mesh);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.neighbours, b.neighbours);
}

TEST(VertexOrder, DoesNotDependOnOffsetAndListOfTriangles) {
  const Mesh mesh = sheet(31, 17);
  Mesh moved;
  for (size_t t = mesh.triangles.size(); t > 0; t -= 3)
    moved.face(mesh.triangles[t - 1], mesh.triangles[t - 3], mesh.triangles[t - 2]);
  for (const int32_t p : mesh.positions)
    moved.positions.push_back(p - 12345);
  for (const int colours : {1, 3}) {
    const VertexOrder a = order_of(mesh, 16, colours), b = order_of(moved, 16, colours);
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.neighbours, b.neighbours);
    EXPECT_EQ(a.level_start, b.level_start);
  }
}

TEST(VertexOrder, ResolvesEqualDistancesByIndex) {
  Mesh mesh = sheet(25, 25);
  for (size_t i = 2; i < mesh.positions.size(); i += 3)
    mesh.positions[i] = 0;
  for (const int colours : {1, 2})
    expect_valid(mesh, order_of(mesh, 24, colours));
  const VertexOrder o = order_of(mesh, 24);
  for (size_t r = 0; r < o.order.size(); ++r)
    for (size_t a = 1; a < 24 && o.neighbours[r * 24 + a] >= 0; ++a) {
      const auto key = [&](int32_t b) {
        const uint32_t v = o.order[static_cast<size_t>(b)];
        const int32_t x = mesh.positions[3 * v] - mesh.positions[3 * o.order[r]];
        const int32_t y = mesh.positions[3 * v + 1] - mesh.positions[3 * o.order[r] + 1];
        return std::tuple(x * x + y * y, v);
      };
      ASSERT_LT(key(o.neighbours[r * 24 + a - 1]), key(o.neighbours[r * 24 + a]));
    }
}

TEST(VertexOrder, RefusesBadArguments) {
  const Mesh mesh = sheet(3, 3);
  VertexOrder o;
  const auto make = [&](const std::vector<uint32_t>& t, const std::vector<int32_t>& p, int m,
                        int c) {
    return make_vertex_order(t.data(), t.size() / 3, p.data(), p.size() / 3, m, c, &o);
  };
  EXPECT_EQ(make(mesh.triangles, mesh.positions, 0, 1), Status::kArgument);
  EXPECT_EQ(make(mesh.triangles, mesh.positions, 25, 1), Status::kArgument);
  EXPECT_EQ(make(mesh.triangles, mesh.positions, 16, 0), Status::kArgument);
  EXPECT_EQ(make(mesh.triangles, mesh.positions, 16, 9), Status::kArgument);
  EXPECT_EQ(make({0, 1, 9}, mesh.positions, 16, 1), Status::kIndexRange);
  std::vector<int32_t> far = mesh.positions;
  far[4] = kMaxReferenceCoordinate + 1;
  EXPECT_EQ(make(mesh.triangles, far, 16, 1), Status::kQuantizer);
  far[4] = kMaxReferenceCoordinate;
  far[7] = -kMaxReferenceCoordinate;
  EXPECT_EQ(make(mesh.triangles, far, 16, 1), Status::kOk);
}

TEST(VertexOrder, IsTheOneThatFilesWereWrittenWith) {
  const VertexOrder o = order_of(sheet(64, 48), 16, 2);
  uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (const int32_t x : o.neighbours)
    for (int byte = 0; byte < 4; ++byte)
      hash = (hash ^ (static_cast<uint32_t>(x) >> (8 * byte) & 255)) * 0x100000001b3;
  for (const uint32_t x : o.order)
    hash = (hash ^ x) * 0x100000001b3;
  EXPECT_EQ(hash, 5481323446092651171u);
}

// Graphs made to cost more than linear time. Quadratic behaviour would take thousands of visits.
constexpr double kMostVisits = 1000;

TEST(SlowVertexOrder, TakesLinearTimeForStarsAndFans) {
  for (const bool shuffled : {false, true}) {
    Mesh star, fan;
    const int n = 200000;
    for (Mesh* mesh : {&star, &fan})
      for (int i = 0; i <= n; ++i)
        mesh->add(shuffled ? i * 7919 % 30011 : 1, shuffled ? i % 3001 : 2, 0);
    for (uint32_t i = 1; i < n; ++i) {
      star.face(0, 0, i);
      fan.face(0, i, i + 1);
    }
    for (const int colours : {1, 8}) {
      EXPECT_LT(visits_of(star, colours), kMostVisits);
      EXPECT_LT(visits_of(fan, colours), kMostVisits);
    }
  }
}

TEST(SlowVertexOrder, TakesLinearTimeForAHubThatComesFirst) {
  Mesh mesh;
  const uint32_t n = 60000;
  for (uint32_t i = 0; i < n; ++i)
    mesh.add(0, 0, 0);
  for (uint32_t i = 1; i < n; ++i)
    for (uint32_t d = 1; d <= 9; ++d)
      mesh.face(0, i, 1 + (i + d) % (n - 1));
  for (const int colours : {1, 8})
    EXPECT_LT(visits_of(mesh, colours), kMostVisits);
}

TEST(SlowVertexOrder, TakesLinearTimeForDenseAndRandomGraphs) {
  Mesh complete, random;
  for (uint32_t i = 0; i < 700; ++i)
    complete.add(static_cast<int32_t>(i * 37 % 101), static_cast<int32_t>(i * 11 % 97), 0);
  for (uint32_t a = 0; a < 700; ++a)
    for (uint32_t b = a + 1; b < 700; ++b)
      complete.face(a, b, b);
  SmallRandom numbers(7);
  const auto next = [&](uint32_t range) { return numbers.below(range); };
  for (int i = 0; i < 100000; ++i)
    random.add(static_cast<int32_t>(next(30000)), static_cast<int32_t>(next(30000)), 0);
  for (int t = 0; t < 200000; ++t)
    random.face(next(100000), next(100000), next(100000));
  for (const int colours : {1, 8}) {
    EXPECT_LT(visits_of(complete, colours), kMostVisits);
    EXPECT_LT(visits_of(random, colours), kMostVisits);
  }
}

}  // namespace
}  // namespace anicodec
