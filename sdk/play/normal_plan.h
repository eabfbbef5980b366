// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_NORMAL_PLAN_H_
#define ANICODEC_SDK_PLAY_NORMAL_PLAN_H_

#include "format/memory.h"
#include "sdk/mesh/topology.h"
#include "sdk/play/vertex_output.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Which corners the normals of a mesh are averaged over. The edges at a corner, from its vertex to
/// the next one and to the one before, span an area; a normal is the sum of those of its corners,
/// of length one. Elements, which are vertices or corners, that share a normal are a group.
///
/// Elements are taken in ranges. The areas that a range needs are computed once each: the corners of a
/// triangle span the same.
struct NormalPlan {
  static constexpr uint32_t kRange = 1024;

  /// A corner: the vertices after and before it in its polygon.
  struct Corner {
    uint32_t next, previous;
  };

  /// An area: the vertices of a triangle, and which groups of the range it is added to; kRange:
  /// none.
  struct Area {
    uint32_t vertex[3];
    uint16_t to[3];
  };

  Vector<uint32_t> group;   ///< of each element
  Vector<uint32_t> centre;  ///< a vertex of each group; the last group has no polygon
  Vector<uint32_t> begin;   ///< group g has corners begin[g] .. begin[g + 1] - 1
  Vector<Corner> corners;

  // The same by areas: list_areas().
  Vector<uint16_t> local;        ///< of each element: its group's number in the range
  Vector<uint32_t> range_begin;  ///< range i has areas range_begin[i] .. range_begin[i + 1] - 1
  Vector<Area> areas;

  uint32_t size() const { return static_cast<uint32_t>(group.size()); }
};

/// Makes a plan. Corners of one coded vertex are in one group when their polygons meet in an edge
/// and their normals in the pose (vertices x 3) are at most an angle of this cosine apart; from -1
/// on downwards, all are. Unless elements are corners, the corners of a vertex are in one group
/// too. Cost: O(corners log corners), 40 bytes for each for a moment.
NormalPlan plan_normals(const Topology& topology, const float* pose, double crease_cosine,
                        bool per_corner);

/// The same from the source's hard edges: corners with one of `shared`, below the number of
/// corners, are in one group.
NormalPlan plan_normals(const Topology& topology, const Vector<uint32_t>& shared, bool per_corner);

/// Lists the areas of a plan whose groups and corners are set. Cost: O(corners log corners).
void list_areas(NormalPlan* plan);

/// Stores normals first .. first + count - 1 of a pose whose vertices are stride bytes apart;
/// (0, 0, 1) where areas cancel. They do not depend on how elements are cut; cuts at multiples of
/// kRange cost least. Allocates nothing, but takes 28 kB of stack.
void compute_normals(const NormalPlan& plan, const float* pose, size_t stride, uint32_t first,
                     uint32_t count, const VertexOutput& output);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_NORMAL_PLAN_H_
