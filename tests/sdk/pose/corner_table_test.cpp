// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/corner_table.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(CornerTable, CornersFaceEachOtherAcrossAnEdge) {
  Vector<uint32_t> triangles{0, 1, 2, 2, 1, 3};
  CornerTable table(4, triangles);
  EXPECT_EQ(table.opposite(0), 5U);
  EXPECT_EQ(table.opposite(5), 0U);
  EXPECT_EQ(table.opposite(1), CornerTable::kNone);
  EXPECT_EQ(table.valence(1), 2U);
  EXPECT_EQ(table.corner(1, 1), 4U);
}

TEST(CornerTable, EdgesOfManyTrianglesJoinThemTwoByTwo) {
  Vector<uint32_t> triangles{0, 1, 2, 0, 1, 3, 1, 0, 4};
  CornerTable table(5, triangles);
  EXPECT_EQ(table.opposite(2), 5U);
  EXPECT_EQ(table.opposite(8), CornerTable::kNone);
}

/// Pairs corners of an edge two by two by a search, as the specification says it.
Vector<uint32_t> opposites(const Vector<uint32_t>& triangles) {
  const auto count = static_cast<uint32_t>(triangles.size());
  const auto edge = [&](uint32_t c) {
    return std::minmax(triangles[next_corner(c)], triangles[previous_corner(c)]);
  };
  Vector<uint32_t> opposite(count, CornerTable::kNone);
  for (uint32_t c = 0; c < count; ++c) {
    for (uint32_t d = c + 1; opposite[c] == CornerTable::kNone && d < count; ++d) {
      if (opposite[d] == CornerTable::kNone && edge(c) == edge(d)) {
        opposite[c] = d;
        opposite[d] = c;
      }
    }
  }
  return opposite;
}

TEST(CornerTable, AnyTrianglesHaveTheirCorners) {
  std::mt19937 random(3);
  for (uint32_t n : {1U, 2U, 5U, 40U}) {
    Vector<uint32_t> triangles(300);
    for (uint32_t& v : triangles)
      v = static_cast<uint32_t>(random() % n);
    const CornerTable table(n + 3, triangles);
    const Vector<uint32_t> expected = opposites(triangles);
    for (uint32_t c = 0; c < table.corner_count(); ++c)
      EXPECT_EQ(table.opposite(c), expected[c]) << c;
    uint32_t corners = 0;
    for (uint32_t v = 0; v < table.vertex_count(); ++v) {
      for (uint32_t i = 0; i < table.valence(v); ++i, ++corners)
        EXPECT_EQ(table.vertex(table.corner(v, i)), v);
    }
    EXPECT_EQ(corners, table.corner_count());
  }
  EXPECT_EQ(CornerTable(4, {}).corner_count(), 0U);
}

}  // namespace
}  // namespace anicodec
