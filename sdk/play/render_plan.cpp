// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/render_plan.h"

#include "format/sort.h"
#include "sdk/mesh/polygon_cutter.h"

#include <cstring>
#include <numeric>

namespace anicodec {
namespace {

/// Compares what corners carry.
class CornerOrder {
 public:
  CornerOrder(const Topology& topology, const NormalPlan& normals,
              const Vector<CornerValues>& values)
      : topology_(topology), normals_(normals), values_(values) {}

  /// Negative, 0 or positive; 0: one render vertex.
  int compare(uint32_t a, uint32_t b) const {
    if (int order = compare_numbers(topology_.polygon_corners[a], topology_.polygon_corners[b]);
        order != 0)
      return order;
    if (int order = compare_numbers(normals_.group[a], normals_.group[b]); order != 0)
      return order;
    for (const CornerValues& v : values_) {
      const auto* bytes = static_cast<const unsigned char*>(v.values);
      const size_t n = sizeof(float) * v.components;
      if (int order = std::memcmp(bytes + n * a, bytes + n * b, n); order != 0)
        return order;
    }
    return 0;
  }

 private:
  static int compare_numbers(uint32_t a, uint32_t b) { return a < b ? -1 : a > b; }

  const Topology& topology_;
  const NormalPlan& normals_;
  const Vector<CornerValues>& values_;
};

/// Makes the render vertices and tells that of each corner.
Vector<uint32_t> share_corners(const Topology& topology, const CornerOrder& order,
                               RenderPlan* plan) {
  Vector<uint32_t> sorted(topology.polygon_corners.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  sort_ascending(sorted.begin(), sorted.end(), [&](uint32_t a, uint32_t b) {
    const int compared = order.compare(a, b);
    return compared != 0 ? compared < 0 : a < b;
  });
  Vector<uint32_t> of_corner(sorted.size());
  for (size_t i = 0; i < sorted.size(); ++i) {
    const uint32_t c = sorted[i];
    if (i == 0 || order.compare(sorted[i - 1], c) != 0) {
      plan->vertices.push_back(topology.polygon_corners[c]);
      plan->corners.push_back(c);
    }
    of_corner[c] = plan->size() - 1;
  }
  return of_corner;
}

void add_triangles(const Topology& topology, const Vector<uint32_t>& of_corner,
                   const uint32_t* labels, const float* positions, RenderPlan* plan) {
  PolygonCutter cutter(positions, of_corner.size());
  Vector<uint32_t> triangles;
  const auto polygons = static_cast<uint32_t>(topology.polygon_offsets.size() - 1);
  Vector<uint32_t> sorted(polygons);
  std::iota(sorted.begin(), sorted.end(), 0U);
  if (labels)
    sort_ascending(sorted.begin(), sorted.end(), [&](uint32_t a, uint32_t b) {
      return labels[a] != labels[b] ? labels[a] < labels[b] : a < b;
    });
  for (const uint32_t p : sorted) {
    const uint32_t first = topology.polygon_offsets[p], end = topology.polygon_offsets[p + 1];
    if (end - first < 3)
      continue;
    const uint32_t label = labels ? labels[p] : 0;
    if (plan->group_labels.empty() || plan->group_labels.back() != label) {
      plan->group_labels.push_back(label);
      plan->group_begin.push_back(static_cast<uint32_t>(plan->triangle_polygons.size()));
    }
    triangles.clear();
    cutter.cut(topology.polygon_corners.data() + first, end - first, &triangles);
    for (const uint32_t c : triangles)
      plan->indices.push_back(of_corner[first + c]);
    plan->triangle_polygons.resize(plan->indices.size() / 3, p);
  }
  plan->group_begin.push_back(static_cast<uint32_t>(plan->triangle_polygons.size()));
}

/// Normals of render vertices from positions of render vertices.
void add_normals(const Topology& topology, const NormalPlan& of_corners, RenderPlan* plan) {
  Vector<uint32_t> any(topology.vertex_coded.size(), 0);  // a render vertex of each vertex
  for (uint32_t r = plan->size(); r-- > 0;)
    any[plan->vertices[r]] = r;
  NormalPlan& to = plan->normals;
  to.begin = of_corners.begin;
  to.centre.resize(of_corners.centre.size());
  to.corners.resize(of_corners.corners.size());
  // The last group is that of elements without a corner; it has no vertex of its own.
  for (size_t g = 0; g + 1 < to.centre.size(); ++g)
    to.centre[g] = any[of_corners.centre[g]];
  for (size_t c = 0; c < to.corners.size(); ++c)
    to.corners[c] = {any[of_corners.corners[c].next], any[of_corners.corners[c].previous]};
  to.group.resize(plan->size());
  const auto none = static_cast<uint32_t>(to.centre.size() - 1);
  for (uint32_t r = 0; r < plan->size(); ++r)
    to.group[r] = of_corners.group.empty() ? none : of_corners.group[plan->corners[r]];
  list_areas(&to);
}

}  // namespace

RenderPlan plan_rendering(const Topology& topology, const NormalPlan& normals,
                          const Vector<CornerValues>& values, const uint32_t* polygon_labels,
                          const float* positions) {
  RenderPlan plan;
  const Vector<uint32_t> of_corner =
      share_corners(topology, CornerOrder(topology, normals, values), &plan);
  if (of_corner.empty()) {
    plan.vertices.resize(topology.vertex_coded.size());
    std::iota(plan.vertices.begin(), plan.vertices.end(), 0U);
    plan.corners.assign(plan.vertices.size(), 0);
  }
  add_triangles(topology, of_corner, polygon_labels, positions, &plan);
  add_normals(topology, normals, &plan);
  return plan;
}

}  // namespace anicodec
