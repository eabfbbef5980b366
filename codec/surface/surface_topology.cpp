// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_topology.h"

#include "codec/sequence/error.h"
#include "sdk/mesh/half_edges.h"

#include <algorithm>
#include <string>

namespace anicodec {
IndexLists::IndexLists(std::span<const std::array<uint32_t, 2>> sorted, uint32_t list_count)
    : first_(size_t{list_count} + 1, 0) {
  items_.reserve(sorted.size());
  for (const auto& [list, item] : sorted) {
    ++first_[list + 1];
    items_.push_back(item);
  }
  for (size_t list = 0; list < list_count; ++list)
    first_[list + 1] += first_[list];
}

SurfaceTopology::SurfaceTopology(std::span<const uint32_t> corners, uint32_t vertices)
    : vertex_count(vertices) {
  std::vector<std::array<uint32_t, 2>> pairs;
  for (size_t c = 0; c + 2 < corners.size(); c += 3) {
    Triangle t{corners[c], corners[c + 1], corners[c + 2]};
    for (uint32_t v : t) {
      if (v >= vertices)
        throw Error(ErrorKind::kInput,
                    "a face uses vertex " + std::to_string(v) + " of " + std::to_string(vertices));
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      continue;
    for (uint32_t v : t)
      pairs.push_back({v, static_cast<uint32_t>(triangles.size())});
    triangles.push_back(t);
  }
  std::sort(pairs.begin(), pairs.end());
  star = IndexLists(pairs, vertices);

  across.assign(triangles.size(), {kNone, kNone, kNone});
  kind.assign(vertices, VertexKind::kInner);
  boundary_neighbours.assign(vertices, {kNone, kNone});
  std::vector<uint32_t> boundary_edges(vertices, 0);
  std::vector<bool> pinned(vertices, false);
  pairs.clear();
  std::vector<uint32_t> kept;  // corners of the triangles
  for (const Triangle& t : triangles)
    kept.insert(kept.end(), t.begin(), t.end());
  HalfEdges(vertices, kept)
      .for_each_edge([&](uint32_t low, uint32_t high, const HalfEdges::Item* first,
                         const HalfEdges::Item* last) {
        pairs.push_back({low, high});
        pairs.push_back({high, low});
        if (last - first == 1) {
          for (auto [from, to] : {std::pair(low, high), std::pair(high, low)}) {
            if (boundary_edges[from] < 2)
              boundary_neighbours[from][boundary_edges[from]] = to;
            ++boundary_edges[from];
          }
        } else if (last - first == 2 && kept[first[0].corner] != kept[first[1].corner]) {
          const uint32_t a = previous_corner(first[0].corner), b = previous_corner(first[1].corner);
          across[a / 3][a % 3] = b / 3;
          across[b / 3][b % 3] = a / 3;
        } else {
          pinned[low] = pinned[high] = true;
        }
      });
  std::sort(pairs.begin(), pairs.end());
  ring = IndexLists(pairs, vertices);
  for (uint32_t v = 0; v < vertices; ++v) {
    if (pinned[v] || star[v].empty() || boundary_edges[v] == 1 || boundary_edges[v] > 2)
      kind[v] = VertexKind::kPinned;
    else if (boundary_edges[v] == 2)
      kind[v] = VertexKind::kBoundary;
    if (kind[v] != VertexKind::kBoundary)
      boundary_neighbours[v] = {kNone, kNone};
  }
}

bool SurfaceTopology::has_boundary() const {
  return std::any_of(across.begin(), across.end(), [](const Triangle& t) {
    return t[0] == kNone || t[1] == kNone || t[2] == kNone;
  });
}

std::vector<uint32_t> components(const SurfaceTopology& topology) {
  std::vector<uint32_t> component(topology.vertex_count, SurfaceTopology::kNone);
  std::vector<uint32_t> open;
  uint32_t count = 0;
  for (uint32_t seed = 0; seed < topology.vertex_count; ++seed) {
    if (component[seed] != SurfaceTopology::kNone)
      continue;
    component[seed] = count;
    open.push_back(seed);
    while (!open.empty()) {
      uint32_t v = open.back();
      open.pop_back();
      for (uint32_t w : topology.ring[v]) {
        if (component[w] == SurfaceTopology::kNone) {
          component[w] = count;
          open.push_back(w);
        }
      }
    }
    ++count;
  }
  return component;
}

std::vector<std::array<uint32_t, 2>> edges(const SurfaceTopology& topology) {
  std::vector<std::array<uint32_t, 2>> list;
  for (uint32_t v = 0; v < topology.vertex_count; ++v) {
    for (uint32_t w : topology.ring[v]) {
      if (v < w)
        list.push_back({v, w});
    }
  }
  return list;
}

}  // namespace anicodec
