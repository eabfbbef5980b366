// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/surface_growth.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

bool is_permutation_of_all(Vector<uint32_t> order, uint32_t n) {
  std::sort(order.begin(), order.end());
  Vector<uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  return order == all;
}

/// (n + 1)^2 vertices, row by row.
Vector<uint32_t> grid(uint32_t n) {
  Vector<uint32_t> triangles;
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      triangles.insert(triangles.end(), {a, b, d, a, d, c});
    }
  }
  return triangles;
}

TEST(SurfaceGrowth, CornersFaceEachOtherAcrossAnEdge) {
  Vector<uint32_t> triangles{0, 1, 2, 2, 1, 3};
  CornerTable table(4, triangles);
  EXPECT_EQ(table.opposite(0), 5U);
  EXPECT_EQ(table.opposite(5), 0U);
  EXPECT_EQ(table.opposite(1), CornerTable::kNone);
  EXPECT_EQ(table.valence(1), 2U);
  EXPECT_EQ(table.corner(1, 1), 4U);
}

TEST(SurfaceGrowth, EdgesOfManyTrianglesJoinThemTwoByTwo) {
  Vector<uint32_t> triangles{0, 1, 2, 0, 1, 3, 1, 0, 4};
  CornerTable table(5, triangles);
  EXPECT_EQ(table.opposite(2), 5U);
  EXPECT_EQ(table.opposite(8), CornerTable::kNone);
}

TEST(SurfaceGrowth, MostVerticesOfAGridComeWithTwoParallelograms) {
  Vector<uint32_t> triangles = grid(30);
  CornerTable table(31 * 31, triangles);
  Vector<uint32_t> order = growth_order(table);
  ASSERT_TRUE(is_permutation_of_all(order, 31 * 31));
  std::vector<bool> done(31 * 31, false);
  size_t several = 0;
  for (uint32_t v : order) {
    int gates = 0;
    for (uint32_t i = 0; i < table.valence(v); ++i) {
      uint32_t c = table.corner(v, i), o = table.opposite(c);
      gates += o != CornerTable::kNone && done[table.vertex(o)] &&
               done[table.vertex(CornerTable::next(c))] &&
               done[table.vertex(CornerTable::previous(c))];
    }
    several += gates >= 2;
    done[v] = true;
  }
  EXPECT_GT(several, 31U * 31U * 8 / 10);
}

TEST(SurfaceGrowth, AnyTrianglesGiveAPermutation) {
  std::mt19937 random(3);
  for (uint32_t n : {1U, 2U, 5U, 40U}) {
    Vector<uint32_t> triangles(300);
    for (uint32_t& v : triangles)
      v = static_cast<uint32_t>(random() % n);
    CornerTable table(n + 3, triangles);
    EXPECT_TRUE(is_permutation_of_all(growth_order(table), n + 3));
  }
  CornerTable empty(4, {});
  EXPECT_EQ(growth_order(empty), (Vector<uint32_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace anicodec
