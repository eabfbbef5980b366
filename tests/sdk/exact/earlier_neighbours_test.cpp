// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/exact/earlier_neighbours.h"

#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

std::vector<uint32_t> of(const EarlierNeighbours& neighbours, uint32_t vertex) {
  const uint32_t* row = neighbours.of(vertex);
  return {row, row + EarlierNeighbours::kCount};
}

TEST(EarlierNeighbours, AreTheLastOnesBeforeAVertexAndRepeat) {
  Topology topology;
  topology.coded_vertices = 9;
  // A fan around vertex 6, whose neighbours are 0 to 5; 7 and 8 are in no triangle, or in a
  // degenerate one.
  topology.triangles = {6, 0, 1, 6, 1, 2, 6, 2, 3, 3, 4, 6, 4, 5, 6, 7, 7, 7};
  const EarlierNeighbours neighbours(topology);
  using Row = std::vector<uint32_t>;
  EXPECT_EQ(of(neighbours, 6), (Row{5, 4, 3, 2}));
  EXPECT_EQ(of(neighbours, 1), (Row{0, 0, 0, 0}));
  EXPECT_EQ(of(neighbours, 4), (Row{3, 3, 3, 3}));
  EXPECT_EQ(of(neighbours, 7), (Row{6, 6, 6, 6}));
  EXPECT_EQ(of(neighbours, 8), (Row{7, 7, 7, 7}));
}

TEST(EarlierNeighbours, TwoAndThreeAreTakenInTurns) {
  Topology topology;
  topology.coded_vertices = 4;
  topology.triangles = {0, 1, 2, 1, 2, 3, 0, 2, 3};
  const EarlierNeighbours neighbours(topology);
  using Row = std::vector<uint32_t>;
  EXPECT_EQ(of(neighbours, 2), (Row{1, 0, 1, 0}));
  EXPECT_EQ(of(neighbours, 3), (Row{2, 1, 0, 2}));
}

}  // namespace
}  // namespace anicodec
