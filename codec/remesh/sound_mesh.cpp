// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/remesh/sound_mesh.h"

#include "codec/connectivity/weld.h"
#include "codec/sequence/error.h"
#include "codec/sequence/triangulate.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace anicodec {
namespace {

using Triangle = SurfaceTopology::Triangle;

/// An edge that no half-edge structure can hold.
struct BadEdge {
  uint32_t a, b;
  uint32_t faces;
};

/// How many triangles have both a and b.
uint32_t faces_at(const SurfaceTopology& topology, uint32_t a, uint32_t b) {
  if (topology.star[b].size() < topology.star[a].size())
    std::swap(a, b);  // a hub is not walked around for each of its edges
  uint32_t count = 0;
  for (uint32_t t : topology.star[a])
    count += std::find(topology.triangles[t].begin(), topology.triangles[t].end(), b) !=
             topology.triangles[t].end();
  return count;
}

/// Whether a triangle at the edge of a and b knows the one beyond it.
bool is_paired(const SurfaceTopology& topology, uint32_t a, uint32_t b) {
  if (topology.star[b].size() < topology.star[a].size())
    std::swap(a, b);
  for (uint32_t t : topology.star[a]) {
    const Triangle& corners = topology.triangles[t];
    for (size_t k = 0; k < 3; ++k) {
      if (corners[k] != a && corners[k] != b &&
          std::find(corners.begin(), corners.end(), b) != corners.end())
        return topology.across[t][k] != SurfaceTopology::kNone;
    }
  }
  return false;
}

std::vector<BadEdge> bad_edges(const SurfaceTopology& topology) {
  std::vector<BadEdge> bad;
  for (uint32_t v = 0; v < topology.vertex_count; ++v) {
    if (topology.kind[v] != VertexKind::kPinned)
      continue;
    for (uint32_t w : topology.ring[v]) {
      if (w < v)
        continue;
      const uint32_t faces = faces_at(topology, v, w);
      if (faces > 2 || (faces == 2 && !is_paired(topology, v, w)))
        bad.push_back({v, w, faces});
    }
  }
  return bad;
}

[[noreturn]] void refuse(const BadEdge& edge) {
  const std::string ends =
      "the edge between vertices " + std::to_string(edge.a) + " and " + std::to_string(edge.b);
  if (edge.faces > 2)
    throw Error(ErrorKind::kInput, ends + " has " + std::to_string(edge.faces) +
                                       " faces; remeshing needs at most two");
  throw Error(ErrorKind::kInput, ends + " has two faces that are wound in opposite ways");
}

/// The triangles in vertices of the source, each standing for those at its place.
std::vector<Triangle> placed_triangles(const std::vector<uint32_t>& corners,
                                       const std::vector<uint32_t>& place, MeshRepairs* repairs) {
  struct Turned {
    Triangle triangle;  ///< its smallest vertex first
    size_t number;
  };

  std::vector<Turned> all;
  *repairs = {};
  for (size_t c = 0; c + 2 < corners.size(); c += 3) {
    Triangle t{place[corners[c]], place[corners[c + 1]], place[corners[c + 2]]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      ++repairs->degenerate;
      continue;
    }
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    all.push_back({t, c});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Turned& a, const Turned& b) { return a.triangle < b.triangle; });
  const auto end = std::unique(all.begin(), all.end(), [](const Turned& a, const Turned& b) {
    return a.triangle == b.triangle;
  });
  repairs->repeated = static_cast<uint32_t>(all.end() - end);
  all.erase(end, all.end());
  std::sort(all.begin(), all.end(),
            [](const Turned& a, const Turned& b) { return a.number < b.number; });
  std::vector<Triangle> triangles;
  triangles.reserve(all.size());
  for (const Turned& t : all)
    triangles.push_back(t.triangle);
  return triangles;
}

SurfaceTopology topology_of(const std::vector<Triangle>& triangles, uint32_t vertices) {
  std::vector<uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  return {corners, vertices};
}

/// Numbers the triangles around a vertex: triangles connected by edges at it have the same number.
std::vector<uint32_t> fans_of(const SurfaceTopology& topology, uint32_t v, uint32_t* fans) {
  const auto star = topology.star[v];
  std::vector<uint32_t> fan(star.size(), SurfaceTopology::kNone);
  std::vector<size_t> open;
  *fans = 0;
  for (size_t seed = 0; seed < star.size(); ++seed) {
    if (fan[seed] != SurfaceTopology::kNone)
      continue;
    fan[seed] = *fans;
    open.push_back(seed);
    while (!open.empty()) {
      const uint32_t t = star[open.back()];
      open.pop_back();
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t next = topology.across[t][k];
        if (topology.triangles[t][k] == v || next == SurfaceTopology::kNone)
          continue;
        const auto at =
            static_cast<size_t>(std::lower_bound(star.begin(), star.end(), next) - star.begin());
        if (fan[at] == SurfaceTopology::kNone) {
          fan[at] = *fans;
          open.push_back(at);
        }
      }
    }
    ++*fans;
  }
  return fan;
}

/// Numbers the vertices that are used, the fans at one apart.
SoundMesh parted(const SurfaceTopology& topology) {
  SoundMesh mesh;
  mesh.triangles = topology.triangles;
  std::vector<uint32_t> extra;
  for (uint32_t v = 0; v < topology.vertex_count; ++v) {
    if (topology.star[v].empty())
      continue;
    uint32_t fans = 0;
    const std::vector<uint32_t> fan = fans_of(topology, v, &fans);
    const auto first = static_cast<uint32_t>(mesh.source.size());
    mesh.source.insert(mesh.source.end(), fans, v);
    mesh.repairs.parted += fans - 1;
    for (size_t i = 0; i < fan.size(); ++i) {
      const uint32_t t = topology.star[v][i];
      for (size_t k = 0; k < 3; ++k) {
        if (topology.triangles[t][k] == v)
          mesh.triangles[t][k] = first + fan[i];
      }
    }
  }
  return mesh;
}

}  // namespace

Positions SoundMesh::frame(std::span<const float> positions) const {
  Positions result(static_cast<Eigen::Index>(source.size()), 3);
  for (size_t i = 0; i < source.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis)
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis)) =
          double{positions[size_t{3} * source[i] + axis]};
  }
  return result;
}

SoundMesh sound_mesh(const MeshSequence& sequence) {
  check(sequence);
  const std::vector<uint32_t> corners = triangulated(sequence.polygons, sequence.frame(0)).corners;
  const Weld weld = weld_trajectories(sequence);
  std::vector<uint32_t> place(sequence.vertex_count);
  for (size_t v = 0; v < place.size(); ++v)
    place[v] = weld.representative[weld.welded[v]];
  MeshRepairs repairs;
  SurfaceTopology topology =
      topology_of(placed_triangles(corners, place, &repairs), sequence.vertex_count);
  std::vector<BadEdge> bad = bad_edges(topology);
  if (!bad.empty()) {
    // Parts that only touch each other in space are welded nowhere along that edge.
    std::vector<bool> apart(sequence.vertex_count, false);
    for (const BadEdge& edge : bad)
      apart[edge.a] = apart[edge.b] = true;
    for (uint32_t v = 0; v < place.size(); ++v) {
      if (apart[place[v]])
        place[v] = v;
    }
    topology = topology_of(placed_triangles(corners, place, &repairs), sequence.vertex_count);
    bad = bad_edges(topology);
  }
  if (!bad.empty())
    refuse(bad.front());
  if (topology.triangles.empty())
    throw Error(ErrorKind::kInput, "a mesh without faces cannot be remeshed");
  SoundMesh mesh = parted(topology);
  mesh.repairs.degenerate = repairs.degenerate;
  mesh.repairs.repeated = repairs.repeated;
  return mesh;
}

UnitBox::UnitBox(const Positions& positions) {
  const Eigen::RowVector3d low = positions.colwise().minCoeff(),
                           high = positions.colwise().maxCoeff();
  centre_ = (low + high) / 2;
  diagonal_ = (high - low).norm();
  if (!(diagonal_ > 0))
    diagonal_ = 1;
}

Positions UnitBox::to_box(const Positions& positions) const {
  return (positions.rowwise() - centre_) / diagonal_;
}

Positions UnitBox::from_box(const Positions& positions) const {
  return (positions * diagonal_).rowwise() + centre_;
}

}  // namespace anicodec
