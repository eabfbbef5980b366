// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/sparse_ldlt.h"

#include "sdk/msgi/patch_hierarchy.h"
#include "tests/sdk/threads.h"
#include "tests/sdk/triangle_lists.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct System {
  Vector<uint32_t> group;
  Vector<SparseLdlt::Edge> edges;
};

/// The edges of a mesh with random weights, the first vertex of every component fixed.
System system_of(const TriangleList& list, uint32_t leaf_faces = 4) {
  FaceGraph graph =
      make_face_graph(list.triangles.data(), list.triangles.size() / 3, list.vertex_count);
  System system;
  system.group = make_patch_hierarchy(graph, leaf_faces).vertex_node;
  std::vector<bool> started(graph.component_count);
  for (uint32_t v = 0; v < list.vertex_count; ++v) {
    uint32_t c = graph.vertex_component[v];
    if (c != kNoIndex && !started[c]) {
      started[c] = true;
      system.group[v] = SparseLdlt::kFixed;
    }
  }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-3, 3);
  for (const FaceGraph::Edge& e : graph.edges)
    system.edges.push_back({e.a, e.b, std::pow(10, exponent(random))});
  return system;
}

/// Largest |A x - b| against the largest |A| |x|.
double residual(const SparseLdlt& solver, const System& system, const std::vector<double>& x,
                const std::vector<double>& b) {
  std::vector<uint32_t> unknown(system.group.size(), SparseLdlt::kFixed);
  for (uint32_t i = 0; i < solver.size(); ++i)
    unknown[solver.vertices()[i]] = i;
  std::vector<double> product(4 * size_t{solver.size()}), size(product.size(), 1e-300);
  for (const SparseLdlt::Edge& e : system.edges) {
    for (size_t axis = 0; axis < 3; ++axis) {
      auto value = [&](uint32_t v) {
        return unknown[v] == SparseLdlt::kFixed ? 0 : x[4 * size_t{unknown[v]} + axis];
      };
      double pull = e.weight * (value(e.a) - value(e.b));
      for (auto [v, sign] : {std::pair(e.a, 1.0), std::pair(e.b, -1.0)}) {
        if (unknown[v] != SparseLdlt::kFixed) {
          product[4 * size_t{unknown[v]} + axis] += sign * pull;
          size[4 * size_t{unknown[v]} + axis] += e.weight * std::fabs(value(v));
        }
      }
    }
  }
  double worst = 0;
  for (size_t k = 0; k < product.size(); ++k)
    worst = std::max(worst, std::fabs(product[k] - b[k]) / (size[k] + std::fabs(b[k])));
  return worst;
}

std::vector<double> right_side(const SparseLdlt& solver) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> b(solver.scratch_size());
  for (uint32_t i = 0; i < solver.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis)
      b[4 * size_t{i} + axis] = normal(random);
  }
  return b;
}

TEST(SparseLdlt, SolvesSystemsOfAllKindsOfMeshes) {
  std::vector<TriangleList> lists = odd_triangle_lists();
  lists.push_back(grid_list(60, 45));
  for (const TriangleList& list : lists) {
    System system = system_of(list);
    SparseLdlt solver;
    ASSERT_EQ(solver.init(system.group, system.edges, size_t{1} << 30), Status::kOk) << list.name;
    std::vector<double> b = right_side(solver), x = b;
    solver.solve(x.data(), {});
    EXPECT_LE(residual(solver, system, x, b), 1e-12) << list.name;
  }
}

TEST(SparseLdlt, GivesTheSameBitsWithAnyThreads) {
  System system = system_of(grid_list(80, 50));
  SparseLdlt solver;
  ASSERT_EQ(solver.init(system.group, system.edges, size_t{1} << 30), Status::kOk);
  std::vector<double> b = right_side(solver), x = b, y = b;
  solver.solve(x.data(), {});
  solver.solve(y.data(), three_threads());
  EXPECT_EQ(x, y);
}

TEST(SparseLdlt, KeepsTheFactorOfAGridSmall) {
  System system = system_of(grid_list(100, 100), 16);
  SparseLdlt solver;
  ASSERT_EQ(solver.init(system.group, system.edges, size_t{1} << 30), Status::kOk);
  EXPECT_LE(solver.resident_bytes(), 8U * 60U * solver.size());  // about 50 numbers a column
}

TEST(SparseLdlt, RefusesAFactorThatIsTooLarge) {
  System system = system_of(grid_list(60, 60));
  SparseLdlt solver;
  EXPECT_EQ(solver.init(system.group, system.edges, 100000), Status::kLimit);
}

TEST(SparseLdlt, RefusesAMatrixThatIsNotDefinite) {
  SparseLdlt solver;
  EXPECT_EQ(solver.init({0, 1}, {{0, 1, 1.0}}, 1000000), Status::kNonFinite);
}

}  // namespace
}  // namespace anicodec
