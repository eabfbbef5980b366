// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// An order in which the vertices of a triangle mesh are surrounded by earlier ones, found from the
// connectivity alone (spec/09b-reference-pose.md, section 2).
#ifndef ANICODEC_SDK_POSE_SURFACE_GROWTH_H_
#define ANICODEC_SDK_POSE_SURFACE_GROWTH_H_

#include "format/memory.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// The corners of a triangle list by vertex, and pairs of corners that face each other across an
/// edge. Any triangles do: an edge of many triangles joins them two by two in their order.
class CornerTable {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// `triangles`: three vertices below vertex_count each; must outlive the table.
  CornerTable(uint32_t vertex_count, const Vector<uint32_t>& triangles);

  static uint32_t next(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

  static uint32_t previous(uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

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

/// All vertices, each as often as possible with several parallelograms of earlier vertices at hand.
/// Cost: O(vertices + triangles).
Vector<uint32_t> growth_order(const CornerTable& table);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_SURFACE_GROWTH_H_
