// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/manifold_mesh.h"

#include "sdk/base/disjoint_sets.h"
#include "sdk/mesh/details_coding.h"
#include "sdk/mesh/half_edges.h"

#include <algorithm>
#include <compare>
#include <cstring>
#include <numeric>

namespace anicodec {
namespace {

uint64_t mixed(uint64_t h, uint32_t x) {
  h = (h ^ x) * 0x9E3779B97F4A7C15ULL;
  return h ^ (h >> 29);
}

/// Whether the half-edges of an edge are one border or two that lead opposite ways. `vertices`: at
/// each corner.
bool is_manifold(std::span<const uint32_t> vertices, const HalfEdges::Item* first,
                 const HalfEdges::Item* last) {
  return last - first == 1 ||
         (last - first == 2 && vertices[first->corner] != vertices[first[1].corner]);
}

/// Marks polygons that no triangle mesh can hold as such: too few corners or too many, a repeated
/// vertex, or the vertices of an earlier polygon.
std::vector<bool> degenerate_or_duplicate(const Polygons& polygons,
                                          std::span<const uint32_t> welded) {
  std::vector<bool> apart(polygons.size(), false);
  std::vector<uint32_t> sorted;  // vertices of each polygon, ascending
  std::vector<size_t> offsets{0};
  std::vector<std::pair<uint64_t, uint32_t>> keys;  // hash, polygon
  sorted.reserve(polygons.corners.size());
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    for (uint32_t v : polygons[p])
      sorted.push_back(welded[v]);
    auto begin = sorted.begin() + static_cast<ptrdiff_t>(offsets.back());
    std::sort(begin, sorted.end());
    apart[p] = sorted.end() - begin < 3 || polygons[p].size() > kMaxJoinedCorners ||
               std::adjacent_find(begin, sorted.end()) != sorted.end();
    if (!apart[p])
      keys.emplace_back(std::accumulate(begin, sorted.end(), uint64_t{0}, mixed), p);
    offsets.push_back(sorted.size());
  }
  auto vertices = [&](uint32_t p) {
    return std::span(sorted).subspan(offsets[p], offsets[p + 1] - offsets[p]);
  };
  auto order = [&](const auto& a, const auto& b) {
    if (a.first != b.first)
      return a.first < b.first;
    const auto x = vertices(a.second), y = vertices(b.second);
    const auto by_vertices =
        std::lexicographical_compare_three_way(x.begin(), x.end(), y.begin(), y.end());
    return by_vertices != 0 ? by_vertices < 0 : a.second < b.second;
  };
  std::sort(keys.begin(), keys.end(), order);
  // Those of the same vertices are neighbours now, the first of the source before the others.
  for (size_t i = 1; i < keys.size(); ++i)
    apart[keys[i].second] =
        std::ranges::equal(vertices(keys[i - 1].second), vertices(keys[i].second));
  return apart;
}

/// Calls visit(polygon) for the polygons that have more than one of the half-edges, which are on
/// the same edge.
template <class Visit>
void for_each_repeated(std::span<const HalfEdges::Item> edges,
                       const std::vector<uint32_t>& triangle_polygon, Visit visit) {
  std::vector<uint32_t> polygons;
  for (const HalfEdges::Item& edge : edges)
    polygons.push_back(triangle_polygon[edge.corner / 3]);
  std::sort(polygons.begin(), polygons.end());
  for (size_t i = 1; i < polygons.size(); ++i) {
    if (polygons[i] == polygons[i - 1])
      visit(polygons[i]);
  }
}

}  // namespace

Weld weld_trajectories(const MeshSequence& sequence) {
  uint32_t n = sequence.vertex_count;
  std::vector<uint64_t> hash(n, 0);
  for (size_t f = 0; f < sequence.frame_count; ++f) {
    std::span<const float> frame = sequence.frame(f);
    for (size_t v = 0; v < n; ++v) {
      uint32_t bits[3];
      std::memcpy(bits, frame.data() + 3 * v, sizeof bits);
      hash[v] = mixed(mixed(mixed(hash[v], bits[0]), bits[1]), bits[2]);
    }
  }
  auto identical = [&](uint32_t a, uint32_t b) {
    for (size_t f = 0; f < sequence.frame_count; ++f) {
      const float* frame = sequence.frame(f).data();
      if (std::memcmp(frame + size_t{3} * a, frame + size_t{3} * b, 3 * sizeof(float)) != 0)
        return false;
    }
    return true;
  };
  std::vector<uint32_t> order(n), first(n);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return hash[a] != hash[b] ? hash[a] < hash[b] : a < b; });
  // Vertices of one hash are compared with the first one of it; a collision stays unwelded, which
  // costs bytes, not correctness.
  for (size_t i = 0, head = 0; i < n; ++i) {
    if (hash[order[i]] != hash[order[head]])
      head = i;
    first[order[i]] = i != head && identical(order[head], order[i]) ? order[head] : order[i];
  }
  Weld weld;
  weld.welded.resize(n);
  for (uint32_t v = 0; v < n; ++v) {
    if (first[v] == v) {
      weld.welded[v] = static_cast<uint32_t>(weld.representative.size());
      weld.representative.push_back(v);
    } else {
      weld.welded[v] = weld.welded[first[v]];
    }
  }
  return weld;
}

ManifoldMesh make_manifold(const Polygons& polygons, std::span<const uint32_t> welded) {
  std::vector<bool> apart = degenerate_or_duplicate(polygons, welded);
  const size_t weld_count = welded.empty() ? 0 : size_t{std::ranges::max(welded)} + 1;
  ManifoldMesh mesh;
  for (bool settled = false; !settled;) {
    settled = true;
    std::vector<uint32_t> vertices;  // welded vertex at each corner of the fans
    mesh.triangle_polygon.clear();
    for (uint32_t p = 0; p < polygons.size(); ++p) {
      if (apart[p])
        continue;
      std::span<const uint32_t> corners = polygons[p];
      for (size_t i = 1; i + 1 < corners.size(); ++i) {
        for (uint32_t v : {corners[0], corners[i], corners[i + 1]})
          vertices.push_back(welded[v]);
        mesh.triangle_polygon.push_back(p);
      }
    }
    auto set_apart = [&](uint32_t polygon) {
      apart[polygon] = true;
      settled = false;
    };

    DisjointSets points(vertices.size());  // of corners
    const auto visit_edge = [&](uint32_t, uint32_t, const HalfEdges::Item* first,
                                const HalfEdges::Item* last) {
      if (!is_manifold(vertices, first, last)) {
        // A polygon with such an edge between two of its triangles could not be put together again.
        for_each_repeated(std::span(first, last), mesh.triangle_polygon, set_apart);
      } else if (last - first == 2) {
        uint32_t c = first[0].corner, d = first[1].corner;
        points.join(c, next_corner(d));
        points.join(next_corner(c), d);
      }
    };
    HalfEdges(weld_count, vertices).for_each_edge(visit_edge);
    if (!settled)
      continue;

    mesh.triangles.assign(vertices.size(), 0);
    mesh.point_vertex.clear();
    for (uint32_t c = 0; c < vertices.size(); ++c) {
      uint32_t root = points.find(c);
      if (root == c) {
        mesh.triangles[c] = static_cast<uint32_t>(mesh.point_vertex.size());
        mesh.point_vertex.push_back(vertices[c]);
      } else {
        mesh.triangles[c] = mesh.triangles[root];
      }
    }
    // Fans that meet again around a vertex can bring the same points back to a cut edge.
    HalfEdges(mesh.point_vertex.size(), mesh.triangles)
        .for_each_edge(
            [&](uint32_t, uint32_t, const HalfEdges::Item* first, const HalfEdges::Item* last) {
              if (!is_manifold(mesh.triangles, first, last))
                set_apart(mesh.triangle_polygon[last[-1].corner / 3]);
            });
  }
  mesh.points = static_cast<uint32_t>(mesh.point_vertex.size());
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    if (apart[p])
      mesh.apart.push_back(p);
  }
  return mesh;
}

}  // namespace anicodec
