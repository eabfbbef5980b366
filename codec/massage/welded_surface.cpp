// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/welded_surface.h"

#include "codec/surface/closest_point.h"

#include <vector>

namespace anicodec {

using Eigen::Index;

WeldedSurface::WeldedSurface(const MeshSequence& sequence) : weld(weld_trajectories(sequence)) {
  std::vector<uint32_t> corners = fan_triangles(sequence.polygons);
  for (uint32_t& c : corners)
    c = weld.welded[c];
  topology = SurfaceTopology(corners, static_cast<uint32_t>(weld.representative.size()));
}

Positions WeldedSurface::frame(std::span<const float> positions) const {
  Positions result(static_cast<Index>(weld.representative.size()), 3);
  for (size_t i = 0; i < weld.representative.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis)
      result(static_cast<Index>(i), static_cast<Index>(axis)) =
          double{positions[size_t{3} * weld.representative[i] + axis]};
  }
  return result;
}

void WeldedSurface::store(const Positions& welded, std::span<float> positions) const {
  for (size_t i = 0; i < weld.welded.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis)
      positions[3 * i + axis] =
          static_cast<float>(welded(static_cast<Index>(weld.welded[i]), static_cast<Index>(axis)));
  }
}

}  // namespace anicodec
