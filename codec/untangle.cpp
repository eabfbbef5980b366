// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/untangle.h"

#include "codec/mesh_quality.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr int kMostPasses = 40;
constexpr double kHeight = 0.002;     // that a triangle is left with, about, in its sides
constexpr double kLongestMove = 0.5;  // mean edges

/// Moves inner corners along the gradient of the area that the triangle has from above.
void turn(const SurfaceTopology& topology, const SurfaceTopology::Triangle& corners,
          const Vector3d& up, double longest, Positions* v) {
  const double area = area_normal(*v, corners).dot(up);
  Vector3d gradient[3];
  double all = 0, moving = 0;
  for (size_t k = 0; k < 3; ++k) {
    gradient[k] = up.cross(row(*v, corners[(k + 2) % 3]) - row(*v, corners[(k + 1) % 3]));
    all += gradient[k].squaredNorm();
    if (topology.kind[corners[k]] == VertexKind::kInner)
      moving += gradient[k].squaredNorm();
  }
  if (!(moving > 0))
    return;
  for (size_t k = 0; k < 3; ++k) {
    if (topology.kind[corners[k]] != VertexKind::kInner)
      continue;
    Vector3d move = (kHeight * all - area) / moving * gradient[k];
    const double length = move.norm();
    if (length > longest)
      move *= longest / length;
    v->row(static_cast<Index>(corners[k])) =
        (row(*v, corners[k]) + move).cast<float>().cast<double>().transpose();
  }
}

}  // namespace

uint32_t untangle(const Surface& surface, Positions* v) {
  const SurfaceTopology& topology = surface.topology();
  const double longest = kLongestMove * mean_edge(topology, surface.positions());
  *v = v->cast<float>().cast<double>().eval();
  std::vector<uint32_t> turned = turned_in_place(*v, surface);
  std::vector<bool> ever(topology.triangles.size(), false);
  for (int pass = 0; pass < kMostPasses && !turned.empty(); ++pass) {
    std::vector<uint32_t> touched;
    for (uint32_t t : turned) {
      const SurfaceTopology::Triangle& corners = topology.triangles[t];
      const Vector3d up =
          area_normal(surface.positions(), topology.triangles[place_below(*v, t, surface)]);
      turn(topology, corners, up.normalized(), longest, v);
      ever[t] = true;
      for (uint32_t corner : corners)
        touched.insert(touched.end(), topology.star[corner].begin(), topology.star[corner].end());
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    turned.clear();
    std::copy_if(touched.begin(), touched.end(), std::back_inserter(turned),
                 [&](uint32_t t) { return is_turned_in_place(*v, t, surface); });
  }
  return static_cast<uint32_t>(std::count(ever.begin(), ever.end(), true)) -
         static_cast<uint32_t>(turned.size());
}

}  // namespace anicodec
