// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_SPLIT_VERTICES_H_
#define ANICODEC_SDK_MESH_SPLIT_VERTICES_H_

#include "format/memory.h"

#include <cstdint>

namespace anicodec {

/// Triangles over points: vertices split until the triangles at each are one fan, open or closed.
struct SplitMesh {
  static constexpr uint32_t kNone = UINT32_MAX;

  uint32_t points = 0;
  Vector<uint32_t> corners;   ///< point at each corner, numbered by its first
  Vector<uint32_t> opposite;  ///< of the side that starts at a corner: the corner where the other
                              ///< triangle's begins, or kNone
};

/// Two triangles are neighbours at an edge that just these two have, if they lead along it in
/// opposite ways and no vertex is twice in one of them (spec/07-topology.md, section 7).
/// Cost: O(triangles log valence); 12 bytes a vertex, 48 a triangle while it runs.
SplitMesh split_vertices(const Vector<uint32_t>& triangles, uint32_t vertex_count);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_SPLIT_VERTICES_H_
