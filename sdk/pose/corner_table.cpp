// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/corner_table.h"

#include <utility>

namespace anicodec {

CornerTable::CornerTable(uint32_t vertex_count, const Vector<uint32_t>& triangles)
    : triangles_(triangles),
      start_(size_t{vertex_count} + 1, 0),
      corners_(triangles.size()),
      opposite_(triangles.size(), kNone) {
  auto count = static_cast<uint32_t>(triangles.size());
  for (uint32_t v : triangles)
    ++start_[size_t{v} + 1];
  for (size_t v = 0; v < vertex_count; ++v)
    start_[v + 1] += start_[v];
  Vector<uint32_t> end(start_.begin(), start_.end() - 1);
  for (uint32_t c = 0; c < count; ++c)
    corners_[end[triangles[c]]++] = c;

  pair_corners(vertex_count);
}

/// Makes corners that face the same edge opposite to one another, two by two in their order.
void CornerTable::pair_corners(uint32_t vertex_count) {
  const auto count = corner_count();
  const auto ends = [&](uint32_t corner) {
    const uint32_t a = triangles_[next_corner(corner)], b = triangles_[previous_corner(corner)];
    return a < b ? std::pair(a, b) : std::pair(b, a);
  };

  struct Facing {
    uint32_t high, corner;
  };

  // By the lower end of the edge, in their order.
  Vector<uint32_t> begin(size_t{vertex_count} + 1, 0);
  for (uint32_t c = 0; c < count; ++c)
    ++begin[size_t{ends(c).first} + 1];
  for (size_t v = 0; v < vertex_count; ++v)
    begin[v + 1] += begin[v];
  Vector<Facing> facing(count);
  {
    Vector<uint32_t> end(begin.begin(), begin.end() - 1);
    for (uint32_t c = 0; c < count; ++c) {
      const auto [low, high] = ends(c);
      facing[end[low]++] = {high, c};
    }
  }

  // By the higher end: the corner that waits for another one, at an edge from `low`.
  struct Waiting {
    uint32_t low, corner;
  };

  Vector<Waiting> waiting(vertex_count, Waiting{kNone, kNone});
  for (uint32_t low = 0; count > 0 && low < vertex_count; ++low) {
    for (uint32_t i = begin[low]; i < begin[low + 1]; ++i) {
      const auto [high, corner] = facing[i];
      Waiting& other = waiting[high];
      if (other.low == low) {
        opposite_[corner] = other.corner;
        opposite_[other.corner] = corner;
        other.low = kNone;
      } else {
        other = {low, corner};
      }
    }
  }
}

}  // namespace anicodec
