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
struct NormalPlan {
  /// A corner: the vertices after and before it in its polygon.
  struct Corner {
    uint32_t next, previous;
  };

  Vector<uint32_t> group;   ///< of each element
  Vector<uint32_t> centre;  ///< a vertex of each group
  Vector<uint32_t> begin;   ///< group g has corners begin[g] .. begin[g + 1] - 1
  Vector<Corner> corners;

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

/// Stores normals first .. first + count - 1 of a pose whose vertices are stride bytes apart;
/// (0, 0, 1) where areas cancel. Allocates nothing.
void compute_normals(const NormalPlan& plan, const float* pose, size_t stride, uint32_t first,
                     uint32_t count, const VertexOutput& output);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_NORMAL_PLAN_H_
