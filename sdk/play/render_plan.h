// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_RENDER_PLAN_H_
#define ANICODEC_SDK_PLAY_RENDER_PLAN_H_

#include "format/memory.h"
#include "sdk/mesh/topology.h"
#include "sdk/play/normal_plan.h"

#include <cstdint>

namespace anicodec {

/// Numbers of corners, `components` of 32 bits for each.
struct CornerValues {
  const void* values;
  uint32_t components;
};

/// The vertices that a graphics card needs: one for each distinct pair of a vertex and what its
/// corners carry. They are ordered by vertex, so that a range of them takes a range of vertices.
struct RenderPlan {
  Vector<uint32_t> vertices;  ///< of each render vertex; ascending
  Vector<uint32_t> corners;   ///< a corner of each render vertex; 0 in a mesh without corners
  Vector<uint32_t> indices;   ///< triangles x 3 render vertices, ordered by label
  Vector<uint32_t> triangle_polygons;
  Vector<uint32_t> group_labels;  ///< ascending; labels without a triangle are left out
  Vector<uint32_t> group_begin;   ///< group g has triangles begin[g] .. begin[g + 1] - 1
  NormalPlan normals;             ///< elements, and vertices of its corners, are render vertices

  uint32_t size() const { return static_cast<uint32_t>(vertices.size()); }
};

/// Makes a plan. Corners of a vertex share a render vertex when `normals` (one for each corner) has
/// them in one group and all `values` are the same bit for bit. Polygons become triangles by
/// `positions` (PolygonCutter), ordered by their labels (null: all 0). Vertices without a corner are
/// left out, unless no vertex has one: points are render vertices as they are. Cost: O(corners log
/// corners), 24 bytes for each corner for a moment.
RenderPlan plan_rendering(const Topology& topology, const NormalPlan& normals,
                          const Vector<CornerValues>& values, const uint32_t* polygon_labels,
                          const float* positions);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_RENDER_PLAN_H_
