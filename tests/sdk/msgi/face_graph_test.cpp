// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/face_graph.h"

#include "sdk/msgi/patch_hierarchy.h"

#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

FaceGraph graph_of(const std::vector<uint32_t>& triangles, uint32_t vertices) {
  return make_face_graph(triangles.data(), triangles.size() / 3, vertices);
}

size_t hinge_count(const FaceGraph& graph) {
  size_t ends = 0;
  for (size_t f = 0; f < graph.face_count(); ++f)
    ends += graph.hinge_end[f] - graph.begin[f];
  return ends / 2;
}

TEST(FaceGraph, AnEdgeOfManyFacesHasAChainOfHinges) {
  FaceGraph graph = graph_of({0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 1, 5}, 6);
  EXPECT_EQ(hinge_count(graph), 3U);
  EXPECT_EQ(graph.component_count, 1U);
  EXPECT_EQ(graph.edges.size(), 9U);
}

TEST(FaceGraph, DuplicateFacesStayWithTheirNeighbours) {
  FaceGraph graph = graph_of({0, 1, 2, 0, 1, 2, 1, 3, 2, 2, 1, 0}, 4);
  EXPECT_EQ(graph.component_count, 1U);
  EXPECT_EQ(hinge_count(graph), 3U + 2U + 2U);
}

TEST(FaceGraph, FacesThatShareAVertexAreOneComponent) {
  FaceGraph graph = graph_of({0, 1, 2, 2, 3, 4, 5, 6, 7}, 9);
  EXPECT_EQ(graph.component_count, 2U);
  EXPECT_EQ(hinge_count(graph), 0U);
  EXPECT_EQ(graph.neighbours.size(), 2U);  // the join of the first two
  EXPECT_EQ(graph.vertex_component[4], 0U);
  EXPECT_EQ(graph.vertex_component[6], 1U);
  EXPECT_EQ(graph.vertex_component[8], kNoIndex);
}

TEST(FaceGraph, KeepsFacesWithTwoEqualCornersOnly) {
  FaceGraph graph = graph_of({0, 0, 1, 2, 2, 2, 0, 1, 3}, 4);
  EXPECT_EQ(graph.face_count(), 2U);
  EXPECT_EQ(graph.component_count, 1U);
  EXPECT_EQ(graph.vertex_component[2], kNoIndex);
}

}  // namespace
}  // namespace anicodec
