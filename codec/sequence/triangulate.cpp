// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/triangulate.h"

#include "sdk/mesh/polygon_cutter.h"

#include <array>

namespace anicodec {

std::vector<uint32_t> corner_triangles(const Polygons& polygons, std::span<const float> positions) {
  std::vector<uint32_t> out;
  out.reserve(polygons.corners.size());
  PolygonCutter cutter(positions.data(), polygons.corners.size());
  Vector<uint32_t> triangles;
  for (size_t p = 0; p < polygons.size(); ++p) {
    triangles.clear();
    cutter.cut(polygons[p].data(), static_cast<uint32_t>(polygons[p].size()), &triangles);
    for (const uint32_t corner : triangles)
      out.push_back(polygons.offsets[p] + corner);
  }
  return out;
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
