// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/split_vertices.h"

#include "sdk/base/disjoint_sets.h"
#include "sdk/mesh/half_edges.h"

namespace anicodec {

SplitMesh split_vertices(const Vector<uint32_t>& triangles, uint32_t vertex_count) {
  const auto count = static_cast<uint32_t>(triangles.size());
  const auto is_sound = [&](uint32_t corner) {
    const uint32_t* t = &triangles[corner - corner % 3];
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  };
  SplitMesh split;
  split.opposite.assign(count, SplitMesh::kNone);
  DisjointSets points(count);  // of corners
  HalfEdges(vertex_count, triangles)
      .for_each_edge(
          [&](uint32_t, uint32_t, const HalfEdges::Item* first, const HalfEdges::Item* last) {
            if (last - first != 2)
              return;
            const uint32_t c = first[0].corner, d = first[1].corner;
            if (triangles[c] == triangles[d] || !is_sound(c) || !is_sound(d))
              return;
            split.opposite[c] = d;
            split.opposite[d] = c;
            points.join(c, next_corner(d));
            points.join(next_corner(c), d);
          });
  split.corners.assign(count, SplitMesh::kNone);
  Vector<uint32_t> number(count, SplitMesh::kNone);  // of the point of a set, at its root
  for (uint32_t c = 0; c < count; ++c) {
    uint32_t& n = number[points.find(c)];
    if (n == SplitMesh::kNone)
      n = split.points++;
    split.corners[c] = n;
  }
  return split;
}

}  // namespace anicodec
