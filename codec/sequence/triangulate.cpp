// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/triangulate.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#ifdef ANICODEC_EARCUT
#include <mapbox/earcut.hpp>
#endif

namespace anicodec {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<uint32_t, 3>;

Vector3d place(std::span<const float> positions, uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3f>(positions.data() + size_t{3} * vertex).cast<double>();
}

/// Twice the area of a polygon, along its mean normal (Newell).
Vector3d area_of(const std::vector<Vector3d>& ring) {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 2; i < ring.size(); ++i)
    sum += (ring[i - 1] - ring[0]).cross(ring[i] - ring[0]);
  return sum;
}

bool is_fan(const std::vector<Vector3d>& ring, const Vector3d& normal) {
  constexpr double kRounding = 1e-9;  // of the area
  const double least = -kRounding * normal.squaredNorm();
  for (size_t i = 2; i < ring.size(); ++i) {
    if ((ring[i - 1] - ring[0]).cross(ring[i] - ring[0]).dot(normal) < least)
      return false;
  }
  return true;
}

/// Whether no corner turns against the others by more than a sliver.
bool is_convex(const std::vector<Vector3d>& ring) {
  constexpr double kSliver = 1e-4;  // of the area: it is not seen
  const Vector3d normal = area_of(ring);
  const double least = -kSliver * normal.squaredNorm();
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector3d& here = ring[i];
    const Vector3d before = here - ring[(i + ring.size() - 1) % ring.size()],
                   after = ring[(i + 1) % ring.size()] - here;
    if (before.cross(after).dot(normal) < least)
      return false;
  }
  return true;
}

std::vector<Triangle> fan_of(uint32_t corners) {
  std::vector<Triangle> out;
  for (uint32_t i = 2; i < corners; ++i)
    out.push_back({0, i - 1, i});
  return out;
}

#ifdef ANICODEC_EARCUT
/// Corners in the middle of straight sides, which earcut leaves out, cut the triangle at their side.
void add_missing(uint32_t corners, std::vector<Triangle>* triangles) {
  std::vector<bool> present(corners);
  for (const Triangle& t : *triangles) {
    for (const uint32_t c : t)
      present[c] = true;
  }
  const auto first = static_cast<uint32_t>(std::ranges::find(present, true) - present.begin());
  for (uint32_t from = first, steps = 0; steps < corners;) {
    uint32_t to = (from + 1) % corners, length = 1;
    while (!present[to])
      to = (to + 1) % corners, ++length;
    for (size_t t = 0; length > 1 && t < triangles->size(); ++t) {
      Triangle& cut = (*triangles)[t];
      const auto at = static_cast<size_t>(std::ranges::find(cut, from) - cut.begin());
      if (at == 3 || cut[(at + 1) % 3] != to)
        continue;
      const uint32_t top = cut[(at + 2) % 3];
      cut = {from, (from + 1) % corners, top};
      for (uint32_t i = 1; i < length; ++i)
        triangles->push_back({(from + i) % corners, (from + i + 1) % corners, top});
      break;
    }
    steps += length;
    from = to;
  }
}

std::vector<Triangle> cut_by_ears(const std::vector<Vector3d>& ring, const Vector3d& normal) {
  const auto count = static_cast<uint32_t>(ring.size());
  const Vector3d z = normal.normalized(), x = z.unitOrthogonal(), y = z.cross(x);
  std::vector<std::vector<std::array<double, 2>>> rings(1);
  for (const Vector3d& p : ring)
    rings[0].push_back({x.dot(p - ring[0]), y.dot(p - ring[0])});
  const std::vector<uint32_t> cut = mapbox::earcut<uint32_t>(rings);
  if (cut.empty())
    return fan_of(count);
  std::vector<Triangle> out;
  for (size_t i = 0; i + 2 < cut.size(); i += 3) {
    Triangle t{cut[i], cut[i + 1], cut[i + 2]};
    // In the order of the polygon, so that they face as it does.
    const auto turn = (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]);
    if (turn < 2)
      std::swap(t[1], t[2]);
    out.push_back(t);
  }
  add_missing(count, &out);
  return out.size() == count - 2 ? out : fan_of(count);  // of one that crosses itself
}
#endif

std::vector<Triangle> triangles_of(const std::vector<Vector3d>& ring) {
  const auto count = static_cast<uint32_t>(ring.size());
#ifdef ANICODEC_EARCUT
  constexpr size_t kMostCorners = 4000;  // quadratic for those that cross themselves: 0.2 s
  if (count > 3 && count <= kMostCorners) {
    const Vector3d normal = area_of(ring);
    if (normal.squaredNorm() > 0 && !is_fan(ring, normal))
      return cut_by_ears(ring, normal);
  }
#endif
  return fan_of(count);
}

}  // namespace

std::vector<uint32_t> corner_triangles(const Polygons& polygons, std::span<const float> positions) {
  std::vector<uint32_t> out;
  out.reserve(polygons.corners.size());
  std::vector<Vector3d> ring;
  for (size_t p = 0; p < polygons.size(); ++p) {
    const std::span<const uint32_t> polygon = polygons[p];
    if (polygon.size() < 3)
      continue;
    ring.clear();
    for (size_t c = 0; c < polygon.size() && polygon.size() > 3; ++c)
      ring.push_back(place(positions, polygon[c]));
    ring.resize(polygon.size());
    for (const Triangle& triangle : triangles_of(ring)) {
      for (const uint32_t c : triangle)
        out.push_back(polygons.offsets[p] + c);
    }
  }
  return out;
}

uint32_t count_concave(const Polygons& polygons, std::span<const float> positions) {
  uint32_t count = 0;
  std::vector<Vector3d> ring;
  for (size_t p = 0; p < polygons.size(); ++p) {
    ring.clear();
    for (size_t c = 0; c < polygons[p].size() && polygons[p].size() > 3; ++c)
      ring.push_back(place(positions, polygons[p][c]));
    count += is_convex(ring) ? 0U : 1U;
  }
  return count;
}

Polygons triangulated(const Polygons& polygons, std::span<const float> positions) {
  Polygons out;
  const std::vector<uint32_t> corners = corner_triangles(polygons, positions);
  for (size_t i = 0; i < corners.size(); i += 3)
    out.add(std::array{polygons.corners[corners[i]], polygons.corners[corners[i + 1]],
                       polygons.corners[corners[i + 2]]});
  return out;
}

}  // namespace anicodec
