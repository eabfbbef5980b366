// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/surface_growth.h"

#include "format/sort.h"

#include <algorithm>
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
  struct Facing {
    uint32_t high, corner;

    bool operator<(const Facing& b) const {
      return high != b.high ? high < b.high : corner < b.corner;
    }
  };

  const auto count = corner_count();
  const auto ends = [&](uint32_t corner) {
    const uint32_t a = triangles_[next(corner)], b = triangles_[previous(corner)];
    return a < b ? std::pair(a, b) : std::pair(b, a);
  };
  // By the lower end of the edge: so few to each that sorting them costs little.
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
  for (size_t v = 0; count > 0 && v < vertex_count; ++v) {
    Facing* const first = facing.data() + begin[v];
    Facing* const last = facing.data() + begin[v + 1];
    sort_ascending(first, last);
    for (Facing* e = first; e + 1 < last; ++e) {
      if (e[0].high != e[1].high)
        continue;
      opposite_[e[0].corner] = e[1].corner;
      opposite_[e[1].corner] = e[0].corner;
      ++e;
    }
  }
}

namespace {

/// Vertices waiting at the front, by how well they are surrounded; among equals the one that has
/// waited longest is next.
class Front {
 public:
  explicit Front(const CornerTable& table)
      : table_(table),
        place_(table.vertex_count(), 0),
        gates_(table.vertex_count(), 0),
        known_corners_(table.vertex_count(), 0),
        done_(table.vertex_count(), 0) {}

  /// The next vertex, or the first that is not done when none waits.
  uint32_t next() {
    for (uint32_t p = kPlaces; p-- > 1;) {
      while (head_[p] < waiting_[p].size()) {
        uint32_t v = waiting_[p][head_[p]++];
        if (!done_[v] && place_[v] == p)
          return v;
      }
    }
    while (done_[seed_])
      ++seed_;
    return seed_;
  }

  void add(uint32_t v) {
    done_[v] = 1;
    for (uint32_t i = 0; i < table_.valence(v); ++i) {
      uint32_t c = table_.corner(v, i), o = table_.opposite(c);
      uint32_t a = CornerTable::next(c), b = CornerTable::previous(c);
      // Triangles over the edges of v's triangle: parallelograms that are complete only now.
      for (uint32_t d : {a, b}) {
        uint32_t w = table_.vertex(d), third = table_.vertex(d == a ? b : a);
        uint32_t across = table_.opposite(d);
        known_corners_[w] += 1;
        gates_[w] += done_[third] && across != CornerTable::kNone && done_[table_.vertex(across)];
        enqueue(w);
      }
      if (o != CornerTable::kNone && done_[table_.vertex(a)] && done_[table_.vertex(b)]) {
        gates_[table_.vertex(o)] += 1;
        enqueue(table_.vertex(o));
      }
    }
  }

 private:
  static constexpr uint32_t kMostGates = 4, kFractions = 8;
  static constexpr uint32_t kPlaces = 2 + kFractions * (kMostGates + 1);

  void enqueue(uint32_t v) {
    if (done_[v] || known_corners_[v] == 0)
      return;
    uint32_t place = 1;
    if (gates_[v] > 0) {
      uint64_t known = std::min<uint64_t>(known_corners_[v], uint64_t{2} * table_.valence(v));
      place = 2 + kFractions * std::min(gates_[v], kMostGates) +
              static_cast<uint32_t>((kFractions - 1) * known / (uint64_t{2} * table_.valence(v)));
    }
    if (place == place_[v])
      return;
    place_[v] = static_cast<uint8_t>(place);
    waiting_[place].push_back(v);
  }

  const CornerTable& table_;
  Vector<uint32_t> waiting_[kPlaces];
  size_t head_[kPlaces] = {};
  Vector<uint8_t> place_;
  Vector<uint32_t> gates_;          ///< complete parallelograms
  Vector<uint32_t> known_corners_;  ///< corners of its triangles at vertices that are done
  Vector<uint8_t> done_;
  uint32_t seed_ = 0;
};

}  // namespace

Vector<uint32_t> growth_order(const CornerTable& table) {
  Vector<uint32_t> order;
  order.reserve(table.vertex_count());
  Front front(table);
  while (order.size() < table.vertex_count()) {
    order.push_back(front.next());
    front.add(order.back());
  }
  return order;
}

}  // namespace anicodec
