// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/patch_hierarchy.h"

#include "tests/sdk/triangle_lists.h"

#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

void expect_sound(const std::vector<uint32_t>& triangles, uint32_t vertices, uint32_t leaf_faces) {
  FaceGraph graph = make_face_graph(triangles.data(), triangles.size() / 3, vertices);
  PatchHierarchy h = make_patch_hierarchy(graph, leaf_faces);
  size_t roots = 0, inner_links = 0;
  for (size_t n = 0; n < h.nodes.size(); ++n) {
    const PatchHierarchy::Node& node = h.nodes[n];
    roots += node.parent == kNoIndex;
    if (node.left == kNoIndex) {
      EXPECT_EQ(node.last_leaf, node.first_leaf + 1);
      continue;
    }
    EXPECT_LT(node.left, node.right);
    EXPECT_LT(node.right, n);
    EXPECT_EQ(h.nodes[node.left].last_leaf, h.nodes[node.right].first_leaf);
    EXPECT_LT(node.first_link, node.last_link) << "nothing holds the halves together";
    for (size_t j = node.first_link; j < node.last_link; ++j, ++inner_links) {
      EXPECT_GE(h.links[j].p, node.first_leaf);
      EXPECT_LT(h.links[j].p, h.nodes[node.left].last_leaf);
      EXPECT_GE(h.links[j].q, h.nodes[node.left].last_leaf);
      EXPECT_LT(h.links[j].q, node.last_leaf);
    }
  }
  EXPECT_EQ(roots, graph.component_count);
  EXPECT_EQ(inner_links, h.links.size());
  EXPECT_EQ(h.level_nodes.size(), h.nodes.size());
  std::set<uint32_t> seen_edges;
  for (const PatchHierarchy::PatchEdge& e : h.patch_edges) {
    seen_edges.insert(e.edge);
    EXPECT_EQ(h.slot_vertex[e.slot_a], graph.edges[e.edge].a);
    EXPECT_EQ(h.slot_vertex[e.slot_b], graph.edges[e.edge].b);
  }
  EXPECT_EQ(seen_edges.size(), graph.edges.size());
  // An edge has one end below or at the node of the other.
  for (const FaceGraph::Edge& e : graph.edges) {
    const PatchHierarchy::Node &a = h.nodes[h.vertex_node[e.a]], &b = h.nodes[h.vertex_node[e.b]];
    bool nested = (a.first_leaf <= b.first_leaf && b.last_leaf <= a.last_leaf) ||
                  (b.first_leaf <= a.first_leaf && a.last_leaf <= b.last_leaf);
    EXPECT_TRUE(nested);
  }
}

TEST(PatchHierarchy, IsSoundForAllKindsOfMeshes) {
  for (uint32_t leaf : {1U, 3U, 16U}) {
    for (const TriangleList& list : odd_triangle_lists()) {
      SCOPED_TRACE(list.name);
      expect_sound(list.triangles, list.vertex_count, leaf);
    }
  }
}

TEST(PatchHierarchy, HasBalancedLeavesOnAGrid) {
  TriangleList grid = grid_list(40, 40);
  PatchHierarchy h = make_patch_hierarchy(
      make_face_graph(grid.triangles.data(), grid.triangles.size() / 3, grid.vertex_count), 16);
  // 3042 faces halved 8 times leave about 12 each.
  EXPECT_GE(h.leaf_count(), 3042U / 16);
  EXPECT_LE(h.leaf_count(), 3042U / 6);
  EXPECT_LE(h.level_begin.size(), 13U);
}

}  // namespace
}  // namespace anicodec
