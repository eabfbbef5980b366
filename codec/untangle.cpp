// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/untangle.h"

#include "codec/mesh_quality.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr int kMostPasses = 40;
constexpr int kMostAttempts = 4;
constexpr double kHeight = 0.002;     // that a triangle is left with, about, in its sides
constexpr double kLongestMove = 0.5;  // mean edges

/// Moves corners, inner ones or all, along the gradient of the area that the triangle has from
/// above.
void turn(const SurfaceTopology& topology, const SurfaceTopology::Triangle& corners,
          const Vector3d& up, double longest, bool boundary, Positions* v) {
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

void to_floats(Positions* v) {
  for (Eigen::Index i = 0; i < v->rows(); ++i)
    v->row(i) = float_position(v->row(i).transpose()).transpose();
}

/// `below`: of every triangle, where a walk to what is below it starts.
uint32_t untangle_over(const SurfaceTopology& topology, const Surface& surface,
                       const std::vector<uint32_t>& below, std::vector<uint32_t> turned,
                       bool boundary, Positions* v) {
  const double longest = kLongestMove * mean_edge(topology, *v);
  std::vector<bool> ever(topology.triangles.size(), false);
  for (int pass = 0; pass < kMostPasses && !turned.empty(); ++pass) {
    std::vector<uint32_t> touched;
    for (uint32_t t : turned) {
      const SurfaceTopology::Triangle& corners = topology.triangles[t];
      const Vector3d centre = (row(*v, corners[0]) + row(*v, corners[1]) + row(*v, corners[2])) / 3;
      const Vector3d up =
          area_normal(surface.positions(),
                      surface.topology().triangles[surface.walk(centre, below[t]).triangle]);
      turn(topology, corners, up.normalized(), longest, boundary, v);
      ever[t] = true;
      for (uint32_t corner : corners)
        touched.insert(touched.end(), topology.star[corner].begin(), topology.star[corner].end());
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    turned.clear();
    std::copy_if(touched.begin(), touched.end(), std::back_inserter(turned),
                 [&](uint32_t t) { return is_turned(topology, *v, t, surface, below[t]); });
  }
  return static_cast<uint32_t>(std::count(ever.begin(), ever.end(), true)) -
         static_cast<uint32_t>(turned.size());
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
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::vector<uint32_t> turned = turned_triangles(mesh, *v, surface);
    if (turned.empty())
      break;
    count += untangle_over(mesh, surface, triangles_below(mesh, *v, surface), turned, true, v);
  }
  return count;
}

}  // namespace anicodec
