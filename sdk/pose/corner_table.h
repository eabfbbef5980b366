// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_CORNER_TABLE_H_
#define ANICODEC_SDK_POSE_CORNER_TABLE_H_

#include "format/memory.h"
#include "sdk/mesh/half_edges.h"
#include "sdk/mesh/topology.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// The corners of a triangle list by vertex, and pairs of corners that face each other across an edge
/// (spec/09b-reference-pose.md, section 1): what poses are predicted over. Any triangles do: an edge
/// of many triangles joins them two by two in their order. Cost: O(vertices + triangles). Memory: 24
/// bytes a triangle and 4 a vertex, 24 and 12 more while it is made.
class CornerTable {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// `triangles`: three vertices below vertex_count each; must outlive the table.
  CornerTable(uint32_t vertex_count, const Vector<uint32_t>& triangles);

  /// The topology must outlive the table.
  explicit CornerTable(const Topology& topology)
      : CornerTable(topology.coded_vertices, topology.triangles) {}

  uint32_t vertex_count() const { return static_cast<uint32_t>(start_.size() - 1); }

  uint32_t corner_count() const { return static_cast<uint32_t>(opposite_.size()); }

  uint32_t vertex(uint32_t corner) const { return triangles_[corner]; }

  /// Corner of the other triangle at the edge that faces `corner`, or kNone.
  uint32_t opposite(uint32_t corner) const { return opposite_[corner]; }

  /// Number of triangles at a vertex.
  uint32_t valence(uint32_t v) const { return start_[v + 1] - start_[v]; }

  /// The i-th corner at a vertex, ascending. @pre i < valence(v)
  uint32_t corner(uint32_t v, uint32_t i) const { return corners_[start_[v] + i]; }

 private:
  void pair_corners(uint32_t vertex_count);

  const Vector<uint32_t>& triangles_;
  Vector<uint32_t> start_, corners_, opposite_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_CORNER_TABLE_H_
