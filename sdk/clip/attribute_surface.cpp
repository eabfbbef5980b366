// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/attribute_surface.h"

#include <utility>

namespace anicodec {
namespace {

/// The mean, rounded down; 0 of none, as a polygon without corners has it.
int32_t floor_of(int64_t sum, int64_t count) {
  return count == 0 ? 0 : static_cast<int32_t>(sum / count - (sum % count < 0));
}

}  // namespace

Topology attribute_surface(const CornerGraph& graph, AttributeDomain domain,
                           AttributeEntries entries) {
  Topology surface;
  surface.coded_vertices = entries.count;
  surface.vertex_coded = std::move(entries.of_element);
  const auto at = [&](uint32_t corner) {
    return surface.vertex_coded[domain == AttributeDomain::kCorner    ? corner
                                : domain == AttributeDomain::kPolygon ? graph.polygon(corner)
                                                                      : graph.vertex(corner)];
  };
  for (uint32_t c = 0; c < graph.corner_count(); ++c) {
    const uint32_t other = domain == AttributeDomain::kPolygon ? graph.across(c) : graph.next(c);
    if (other == CornerGraph::kNone || at(other) == at(c))
      continue;
    for (uint32_t entry : {at(c), at(other), at(other)})
      surface.triangles.push_back(entry);
  }
  return surface;
}

PoseGrid surface_pose(const PoseGrid& pose, const Topology& mesh, AttributeDomain domain,
                      const Topology& surface) {
  PoseGrid result;
  std::copy_n(pose.origin, 3, result.origin);
  result.step = pose.step;
  Vector<int64_t> sums(size_t{3} * surface.coded_vertices, 0);
  Vector<uint32_t> counts(surface.coded_vertices, 0);
  const auto add = [&](uint32_t element, uint32_t vertex) {
    const uint32_t entry = surface.vertex_coded[element];
    const int32_t* point = pose.points.data() + size_t{3} * mesh.vertex_coded[vertex];
    ++counts[entry];
    for (size_t axis = 0; axis < 3; ++axis)
      sums[size_t{3} * entry + axis] += point[axis];
  };
  for (uint32_t v = 0; domain == AttributeDomain::kVertex && v < mesh.vertex_coded.size(); ++v)
    add(v, v);
  for (uint32_t p = 0; domain != AttributeDomain::kVertex && p + 1 < mesh.polygon_offsets.size();
       ++p) {
    for (uint32_t c = mesh.polygon_offsets[p]; c < mesh.polygon_offsets[p + 1]; ++c)
      add(domain == AttributeDomain::kCorner ? c : p, mesh.polygon_corners[c]);
  }
  result.points.reserve(sums.size());
  for (size_t i = 0; i < sums.size(); ++i)
    result.points.push_back(floor_of(sums[i], counts[i / 3]));
  return result;
}

}  // namespace anicodec
