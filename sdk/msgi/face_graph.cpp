// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/face_graph.h"

#include "sdk/base/disjoint_sets.h"

#include <algorithm>
#include <utility>

namespace anicodec {
namespace {

struct HalfEdge {
  uint32_t to;    ///< the larger vertex
  uint32_t side;  ///< 3 * face + k
};

/// Turns counts, in element i + 1, into beginnings.
void accumulate(Vector<uint32_t>& counts) {
  for (size_t i = 1; i < counts.size(); ++i)
    counts[i] += counts[i - 1];
}

using Pairs = Vector<std::pair<uint32_t, uint32_t>>;

/// Finds the edges and the hinges between their faces.
Pairs find_edges(FaceGraph& graph) {
  Vector<uint32_t> begin(size_t{graph.vertex_count} + 1);
  auto ends = [&](size_t side) {
    uint32_t a = graph.corners[side];
    uint32_t b = graph.corners[side % 3 == 2 ? side - 2 : side + 1];
    return std::pair(std::min(a, b), std::max(a, b));
  };
  size_t sides = graph.corners.size();
  for (size_t side = 0; side < sides; ++side) {
    auto [low, high] = ends(side);
    begin[low + 1] += low != high;
  }
  accumulate(begin);
  Vector<HalfEdge> half(begin.back());
  Vector<uint32_t> at(begin.begin(), begin.end() - 1);
  for (size_t side = 0; side < sides; ++side) {
    auto [low, high] = ends(side);
    if (low != high)
      half[at[low]++] = {high, static_cast<uint32_t>(side)};
  }
  graph.face_edges.assign(sides, kNoIndex);
  Pairs hinges;
  for (uint32_t v = 0; v < graph.vertex_count; ++v) {
    auto first = half.begin() + begin[v], last = half.begin() + begin[v + 1];
    std::sort(first, last, [](const HalfEdge& p, const HalfEdge& q) {
      return p.to != q.to ? p.to < q.to : p.side < q.side;
    });
    for (auto h = first; h != last; ++h) {
      if (h == first || h->to != (h - 1)->to)
        graph.edges.push_back({v, h->to});
      else if (h->side / 3 != (h - 1)->side / 3)
        hinges.emplace_back((h - 1)->side / 3, h->side / 3);
      graph.face_edges[h->side] = static_cast<uint32_t>(graph.edges.size() - 1);
    }
  }
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
