// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/face_graph.h"

#include "sdk/base/disjoint_sets.h"
#include "sdk/mesh/half_edges.h"

#include <algorithm>
#include <utility>

namespace anicodec {
namespace {

/// Turns counts, in element i + 1, into beginnings.
void accumulate(Vector<uint32_t>& counts) {
  for (size_t i = 1; i < counts.size(); ++i)
    counts[i] += counts[i - 1];
}

using Pairs = Vector<std::pair<uint32_t, uint32_t>>;

/// Finds the edges and the hinges between their faces.
Pairs find_edges(FaceGraph& graph) {
  graph.face_edges.assign(graph.corners.size(), kNoIndex);
  Pairs hinges;
  const HalfEdges half_edges(graph.vertex_count, graph.corners);
  half_edges.for_each_edge(
      [&](uint32_t low, uint32_t high, const HalfEdges::Item* first, const HalfEdges::Item* last) {
        if (low == high)
          return;
        for (const HalfEdges::Item* item = first; item != last; ++item) {
          graph.face_edges[item->corner] = static_cast<uint32_t>(graph.edges.size());
          if (item != first && item[0].corner / 3 != item[-1].corner / 3)
            hinges.emplace_back(item[-1].corner / 3, item[0].corner / 3);
        }
        graph.edges.push_back({low, high});
      });
  return hinges;
}

/// Joins the sets of faces that share a vertex, one join for each pair of sets.
Pairs find_joins(const FaceGraph& graph, DisjointSets& sets) {
  Vector<uint32_t> last(graph.vertex_count, kNoIndex);
  Pairs joins;
  for (size_t i = 0; i < graph.corners.size(); ++i) {
    uint32_t& previous = last[graph.corners[i]];
    auto face = static_cast<uint32_t>(i / 3);
    if (previous != kNoIndex && sets.join(previous, face))
      joins.emplace_back(previous, face);
    previous = face;
  }
  return joins;
}

void list_neighbours(FaceGraph& graph, const Pairs& hinges, const Pairs& joins) {
  size_t faces = graph.face_count();
  graph.begin.assign(faces + 1, 0);
  for (const Pairs* pairs : {&hinges, &joins}) {
    for (auto [f, g] : *pairs) {
      ++graph.begin[f + 1];
      ++graph.begin[g + 1];
    }
  }
  accumulate(graph.begin);
  graph.neighbours.resize(graph.begin.back());
  Vector<uint32_t> at(graph.begin.begin(), graph.begin.end() - 1);
  auto list = [&](const Pairs& pairs) {
    for (auto [f, g] : pairs) {
      graph.neighbours[at[f]++] = g;
      graph.neighbours[at[g]++] = f;
    }
  };
  list(hinges);
  graph.hinge_end = at;
  list(joins);
}

}  // namespace

FaceGraph make_face_graph(const uint32_t* triangles, size_t triangle_count, uint32_t vertex_count) {
  FaceGraph graph;
  graph.vertex_count = vertex_count;
  graph.corners.reserve(3 * triangle_count);
  for (size_t t = 0; t < triangle_count; ++t) {
    const uint32_t* c = triangles + 3 * t;
    if (c[0] != c[1] || c[1] != c[2])
      graph.corners.insert(graph.corners.end(), c, c + 3);
  }
  Pairs hinges = find_edges(graph);
  DisjointSets sets(graph.face_count());
  for (auto [f, g] : hinges)
    sets.join(f, g);
  Pairs joins = find_joins(graph, sets);
  list_neighbours(graph, hinges, joins);

  graph.face_component.resize(graph.face_count());
  graph.vertex_component.assign(vertex_count, kNoIndex);
  for (uint32_t f = 0; f < graph.face_count(); ++f) {
    uint32_t lowest = sets.find(f);
    graph.face_component[f] = lowest == f ? graph.component_count++ : graph.face_component[lowest];
    for (size_t k = 0; k < 3; ++k)
      graph.vertex_component[graph.corners[size_t{3} * f + k]] = graph.face_component[f];
  }
  return graph;
}

}  // namespace anicodec
