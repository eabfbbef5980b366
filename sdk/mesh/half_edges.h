// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_HALF_EDGES_H_
#define ANICODEC_SDK_MESH_HALF_EDGES_H_

#include "format/memory.h"
#include "format/sort.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// In a triangle list, the corner after a corner, in the same triangle.
constexpr uint32_t next_corner(uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// In a triangle list, the corner before a corner, in the same triangle.
constexpr uint32_t previous_corner(uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// The half-edges of triangles or polygons, grouped by undirected edge. A half-edge leads from a
/// corner to the next one of its polygon and is named by that corner. Edges ascend by lower, then by
/// higher vertex; the half-edges of an edge ascend by corner. An edge may have any number of
/// half-edges, and may lead from a vertex to itself: the user decides how to treat both.
class HalfEdges {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  struct Item {
    uint32_t high;  ///< the higher vertex of the edge
    uint32_t corner;
  };

  /// `vertex(corner)` < vertex_count; `next(corner)`: the next corner of the polygon.
  /// Cost: O(vertices + corners log valence); 8 bytes a vertex and a corner.
  template <class Vertex, class Next>
  HalfEdges(size_t vertex_count, uint32_t corner_count, Vertex vertex, Next next)
      : begin_(vertex_count + 1), items_(corner_count) {
    for (uint32_t c = 0; c < corner_count; ++c)
      ++begin_[size_t{std::min(vertex(c), vertex(next(c)))} + 1];
    for (size_t v = 0; v < vertex_count; ++v)
      begin_[v + 1] += begin_[v];
    Vector<uint32_t> end(begin_.begin(), begin_.end() - 1);
    for (uint32_t c = 0; c < corner_count; ++c) {
      const uint32_t a = vertex(c), b = vertex(next(c));
      items_[end[std::min(a, b)]++] = {std::max(a, b), c};
    }
    for (size_t v = 0; v < vertex_count; ++v)
      sort_ascending(items_.data() + begin_[v], items_.data() + begin_[v + 1], precedes);
  }

  /// The half-edges of a triangle list. @pre all vertices < vertex_count
  template <class List>
  HalfEdges(size_t vertex_count, const List& triangles)
      : HalfEdges(
            vertex_count, static_cast<uint32_t>(triangles.size()),
            [&](uint32_t corner) { return triangles[corner]; }, next_corner) {}

  /// Calls visit(low, high, first, last) for each edge in order, with the range of its items.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (size_t low = 0; low + 1 < begin_.size(); ++low) {
      const Item* const end = items_.data() + begin_[low + 1];
      for (const Item *first = items_.data() + begin_[low], *last; first != end; first = last) {
        for (last = first + 1; last != end && last->high == first->high; ++last) {
        }
        visit(static_cast<uint32_t>(low), first->high, first, last);
      }
    }
  }

  /// For each corner, the first corner whose half-edge leads the other way along the same edge, or
  /// kNone. A half-edge from a vertex to itself leads both ways. `vertex`: as given to the
  /// constructor.
  template <class Vertex>
  Vector<uint32_t> opposites(Vertex vertex) const {
    Vector<uint32_t> opposite(items_.size(), kNone);
    for_each_edge([&](uint32_t low, uint32_t high, const Item* first, const Item* last) {
      uint32_t from_low = kNone, from_high = kNone;
      for (const Item* item = last; item-- != first;) {
        if (vertex(item->corner) == low)
          from_low = item->corner;
        if (vertex(item->corner) == high)
          from_high = item->corner;
      }
      for (const Item* item = first; item != last; ++item)
        opposite[item->corner] = vertex(item->corner) == low ? from_high : from_low;
    });
    return opposite;
  }

 private:
  static bool precedes(const Item& a, const Item& b) {
    return a.high != b.high ? a.high < b.high : a.corner < b.corner;
  }

  Vector<uint32_t> begin_;  ///< of the edges of each lower vertex
  Vector<Item> items_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_HALF_EDGES_H_
