// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/mesh_quality.h"

#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace anicodec {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector3d;

constexpr double kMostInMean = 20;
constexpr double kLeastAreaChange = 1e-12;
constexpr double kReach = 0.1;  // of a triangle's longest side

/// The triangle in its own plane: its sides from the first corner, as columns.
Matrix2d flat(const Positions& positions, const SurfaceTopology::Triangle& t) {
  const Vector3d a = row(positions, t[0]);
  const Vector3d e = row(positions, t[1]) - a, g = row(positions, t[2]) - a;
  const double length = e.norm();
  Matrix2d sides = Matrix2d::Zero();
  if (length > 0)
    sides << length, e.dot(g) / length, 0, e.cross(g).norm() / length;
  return sides;
}

Vector3d centre(const Positions& positions, const SurfaceTopology::Triangle& t) {
  return (row(positions, t[0]) + row(positions, t[1]) + row(positions, t[2])) / 3;
}

double longest_side(const Positions& positions, const SurfaceTopology::Triangle& t) {
  return std::max({(row(positions, t[0]) - row(positions, t[1])).norm(),
                   (row(positions, t[1]) - row(positions, t[2])).norm(),
                   (row(positions, t[2]) - row(positions, t[0])).norm()});
}

/// Whether a second triangle with the same corners faces the other way, as where decimation leaves
/// both sides of a thin part.
bool is_doubled(const SurfaceTopology& topology, uint32_t t) {
  const SurfaceTopology::Triangle& across = topology.across[t];
  for (size_t k = 0; k < 3; ++k) {
    if (across[k] != SurfaceTopology::kNone && across[k] == across[(k + 1) % 3])
      return true;
  }
  return false;
}

bool faces_against(const SurfaceTopology& topology, const Positions& positions, uint32_t t,
                   const Surface& surface, uint32_t below) {
  const Vector3d up = area_normal(surface.positions(), surface.topology().triangles[below]);
  return area_normal(positions, topology.triangles[t]).dot(up) < 0 && !is_doubled(topology, t);
}

/// All triangles for which `turned(t)`, ascending.
template <class Turned>
std::vector<uint32_t> all_turned(const SurfaceTopology& topology, const Turned& is_turned) {
  std::vector<uint8_t> turned(topology.triangles.size(), 0);
  parallel_for(uint32_t{0}, static_cast<uint32_t>(turned.size()),
               [&](uint32_t t) { turned[t] = is_turned(t); });
  std::vector<uint32_t> list;
  for (uint32_t t = 0; t < turned.size(); ++t) {
    if (turned[t])
      list.push_back(t);
  }
  return list;
}

double both_ways(double x) {
  return (x + 1 / x) / 2;
}

}  // namespace

RadiusRatio radius_ratio(const SurfaceTopology& topology, const Positions& positions) {
  RadiusRatio result;
  if (topology.triangles.empty())
    return result;
  result.least = 1;
  for (const SurfaceTopology::Triangle& t : topology.triangles) {
    const double a = (row(positions, t[1]) - row(positions, t[2])).norm();
    const double b = (row(positions, t[2]) - row(positions, t[0])).norm();
    const double c = (row(positions, t[0]) - row(positions, t[1])).norm();
    const double product = a * b * c;
    const double ratio =
        product > 0 ? std::max(0.0, (b + c - a) * (c + a - b) * (a + b - c) / product) : 0;
    result.mean += ratio;
    result.least = std::min(result.least, ratio);
  }
  result.mean /= static_cast<double>(topology.triangles.size());
  return result;
}

Distortion distortion(const SurfaceTopology& topology, const Positions& before,
                      const Positions& after) {
  double area_before = 0, area_after = 0;
  for (const SurfaceTopology::Triangle& t : topology.triangles) {
    area_before += area_normal(before, t).norm();
    area_after += area_normal(after, t).norm();
  }
  Distortion result;
  double conformal = 0, area = 0, total = 0;
  for (const SurfaceTopology::Triangle& t : topology.triangles) {
    const Matrix2d from = flat(before, t), to = flat(after, t);
    const double size = from.determinant();
    if (!(size > 0) || !(area_after > 0))
      continue;
    const double change = std::max(to.determinant() / size, kLeastAreaChange);
    const double c = std::max(1.0, (to * from.inverse()).squaredNorm() / (2 * change));
    const double a = both_ways(change * area_before / area_after);
    result.conformal_max = std::max(result.conformal_max, c);
    result.area_max = std::max(result.area_max, a);
    conformal += size * std::min(c, kMostInMean);
    area += size * std::min(a, kMostInMean);
    total += size;
  }
  if (total > 0) {
    result.conformal_mean = conformal / total;
    result.area_mean = area / total;
  }
  return result;
}

std::vector<uint32_t> triangles_below(const SurfaceTopology& topology, const Positions& positions,
                                      const Surface& surface) {
  const auto count = static_cast<uint32_t>(topology.triangles.size());
  std::vector<uint32_t> below(count);
  parallel_for(uint32_t{0}, count, [&](uint32_t t) {
    below[t] = surface.closest(centre(positions, topology.triangles[t])).triangle;
  });
  std::vector<bool> against(count);
  for (uint32_t t = 0; t < count; ++t)
    against[t] = faces_against(topology, positions, t, surface, below[t]);
  auto find_other_side = [&](uint32_t t) {
    const SurfaceTopology::Triangle& corners = topology.triangles[t];
    const double reach = kReach * longest_side(positions, corners);
    for (uint32_t beside : topology.across[t]) {
      if (beside == SurfaceTopology::kNone || against[beside])
        continue;
      const SurfacePoint point = surface.walk(centre(positions, corners), below[beside]);
      if (point.square_distance > reach * reach ||
          faces_against(topology, positions, t, surface, point.triangle))
        continue;
      below[t] = point.triangle;
      against[t] = false;
      return true;
    }
    return false;
  };
  for (bool found = true; found;) {
    found = false;
    for (uint32_t t = 0; t < count; ++t)
      found = (against[t] && find_other_side(t)) || found;
  }
  return below;
}

bool is_turned(const SurfaceTopology& topology, const Positions& positions, uint32_t triangle,
               const Surface& surface, uint32_t start) {
  const Vector3d middle = centre(positions, topology.triangles[triangle]);
  return faces_against(topology, positions, triangle, surface,
                       surface.walk(middle, start).triangle);
}

std::vector<uint32_t> turned_around(const SurfaceTopology& topology, const Positions& positions,
                                    std::span<const uint32_t> vertices, const Surface& surface,
                                    std::span<const uint32_t> below) {
  std::vector<uint32_t> triangles;
  for (uint32_t i : vertices)
    triangles.insert(triangles.end(), topology.star[i].begin(), topology.star[i].end());
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::erase_if(triangles,
                [&](uint32_t t) { return !is_turned(topology, positions, t, surface, below[t]); });
  return triangles;
}

std::vector<uint32_t> turned_triangles(const SurfaceTopology& topology, const Positions& positions,
                                       const Surface& surface) {
  const std::vector<uint32_t> below = triangles_below(topology, positions, surface);
  return all_turned(topology, [&](uint32_t t) {
    return faces_against(topology, positions, t, surface, below[t]);
  });
}

std::vector<uint32_t> turned_in_place(const Positions& positions, const Surface& surface) {
  return all_turned(surface.topology(), [&](uint32_t t) {
    return is_turned(surface.topology(), positions, t, surface, t);
  });
}

}  // namespace anicodec
