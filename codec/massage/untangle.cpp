// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/untangle.h"

#include "codec/surface/mesh_quality.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr int kUntanglePasses = 60;
constexpr int kPassesAlone = 40;  // before what is around is evened out
constexpr int kEvenedEvery = 5;   // passes
constexpr int kMostUntanglings = 4;
constexpr double kHeight = 0.002;     // that a triangle is left with, about, in its sides
constexpr double kLongestMove = 0.5;  // mean edges

/// Moves the corners of a triangle, inner ones or all, along the gradient of the area that it has
/// from above the surface. `start`: where the walk to what is below it starts.
void turn(const SurfaceTopology& topology, uint32_t triangle, const Surface& surface,
          uint32_t start, double longest, bool boundary, Positions* v) {
  const SurfaceTopology::Triangle& corners = topology.triangles[triangle];
  const Vector3d centre = (row(*v, corners[0]) + row(*v, corners[1]) + row(*v, corners[2])) / 3;
  const uint32_t below = surface.walk(centre, start).triangle;
  const Vector3d up =
      area_normal(surface.positions(), surface.topology().triangles[below]).normalized();
  const double area = area_normal(*v, corners).dot(up);
  auto moves = [&](uint32_t i) { return boundary || topology.kind[i] == VertexKind::kInner; };
  Vector3d gradient[3];
  double all = 0, moving = 0;
  for (size_t k = 0; k < 3; ++k) {
    gradient[k] = up.cross(row(*v, corners[(k + 2) % 3]) - row(*v, corners[(k + 1) % 3]));
    all += gradient[k].squaredNorm();
    if (moves(corners[k]))
      moving += gradient[k].squaredNorm();
  }
  if (!(moving > 0))
    return;
  for (size_t k = 0; k < 3; ++k) {
    if (!moves(corners[k]))
      continue;
    Vector3d move = (kHeight * all - area) / moving * gradient[k];
    const double length = move.norm();
    if (length > longest)
      move *= longest / length;
    v->row(static_cast<Index>(corners[k])) = float_position(row(*v, corners[k]) + move).transpose();
  }
}

/// The triangles' corners and what is within some edges of them.
std::vector<uint32_t> vertices_around(const SurfaceTopology& topology,
                                      const std::vector<uint32_t>& triangles, int edges) {
  std::vector<uint32_t> found;
  auto in_order = [&found] {
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  };
  for (uint32_t t : triangles)
    found.insert(found.end(), topology.triangles[t].begin(), topology.triangles[t].end());
  in_order();
  for (int k = 0; k < edges; ++k) {
    for (size_t i = 0, count = found.size(); i < count; ++i)
      found.insert(found.end(), topology.ring[found[i]].begin(), topology.ring[found[i]].end());
    in_order();
  }
  return found;
}

/// Moves inner vertices to the middle of their neighbours and back on the surface, some times over:
/// towards Tutte's embedding ("How to draw a graph", 1963), in which no triangle is turned.
void even_out(const SurfaceTopology& topology, const Surface& surface,
              const std::vector<uint32_t>& below, const std::vector<uint32_t>& vertices, int times,
              Positions* v) {
  for (int k = 0; k < times; ++k) {
    for (uint32_t i : vertices) {
      if (topology.kind[i] != VertexKind::kInner)
        continue;
      Vector3d sum = Vector3d::Zero();
      for (uint32_t j : topology.ring[i])
        sum += row(*v, j);
      const Vector3d middle = sum / static_cast<double>(topology.ring[i].size());
      v->row(static_cast<Index>(i)) =
          float_position(surface.curved(surface.walk(middle, below[topology.star[i][0]])))
              .transpose();
    }
  }
}

void to_floats(Positions* v) {
  for (Index i = 0; i < v->rows(); ++i)
    v->row(i) = float_position(v->row(i).transpose()).transpose();
}

/// `below`: of every triangle, where a walk to what is below it starts.
uint32_t untangle_over(const SurfaceTopology& topology, const Surface& surface,
                       const std::vector<uint32_t>& below, std::vector<uint32_t> turned,
                       bool boundary, Positions* v) {
  const double longest = kLongestMove * mean_edge(topology, *v);
  std::vector<bool> ever(topology.triangles.size(), false);
  Positions alone;  // as the least moves leave them
  std::vector<uint32_t> turned_alone;
  for (int pass = 0; pass < kUntanglePasses && !turned.empty(); ++pass) {
    if (pass == kPassesAlone) {
      alone = *v;
      turned_alone = turned;
    }
    std::vector<uint32_t> changed;  // vertices
    if (pass >= kPassesAlone && (pass - kPassesAlone) % kEvenedEvery == 0) {
      const int edges = 1 + (pass - kPassesAlone) / kEvenedEvery;
      changed = vertices_around(topology, turned, edges);
      even_out(topology, surface, below, changed, edges, v);
    } else {
      for (uint32_t t : turned) {
        turn(topology, t, surface, below[t], longest, boundary, v);
        ever[t] = true;
      }
      changed = vertices_around(topology, turned, 0);
    }
    turned = turned_around(topology, *v, changed, surface, below);
  }
  if (!turned_alone.empty() && 2 * turned.size() > turned_alone.size()) {
    *v = alone;
    turned = turned_alone;
  }
  for (uint32_t t : turned)
    ever[t] = false;
  return static_cast<uint32_t>(std::count(ever.begin(), ever.end(), true));
}

}  // namespace

uint32_t untangle(const Surface& surface, Positions* v) {
  to_floats(v);
  std::vector<uint32_t> same(surface.topology().triangles.size());
  std::iota(same.begin(), same.end(), 0U);
  return untangle_over(surface.topology(), surface, same, turned_in_place(*v, surface), false, v);
}

uint32_t untangle(const SurfaceTopology& mesh, const Surface& surface, Positions* v) {
  to_floats(v);
  uint32_t count = 0;
  for (int attempt = 0; attempt < kMostUntanglings; ++attempt) {
    const std::vector<uint32_t> turned = turned_triangles(mesh, *v, surface);
    if (turned.empty())
      break;
    count += untangle_over(mesh, surface, triangles_below(mesh, *v, surface), turned, true, v);
  }
  return count;
}

}  // namespace anicodec
