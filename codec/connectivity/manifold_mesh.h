// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_MANIFOLD_MESH_H_
#define ANICODEC_CODEC_CONNECTIVITY_MANIFOLD_MESH_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Source vertices whose whole trajectories are bit-identical share one welded vertex: it is coded
/// once, and seams stay closed at any error.
struct Weld {
  std::vector<uint32_t> welded;          ///< welded vertex of each source vertex
  std::vector<uint32_t> representative;  ///< first source vertex of each welded vertex, ascending
};

/// Cost: O(vertices x frames), one pass over the positions, memory 16 bytes per vertex.
Weld weld_trajectories(const MeshSequence& sequence);

/// The part of a mesh that a manifold connectivity coder can store, and what it cannot.
struct ManifoldMesh {
  uint32_t points = 0;                     ///< every point is in a triangle
  std::vector<uint32_t> point_vertex;      ///< welded vertex of each point
  std::vector<uint32_t> triangles;         ///< three points each; every directed edge occurs once
  std::vector<uint32_t> triangle_polygon;  ///< source polygon of each triangle
  std::vector<uint32_t> apart;             ///< source polygons that are stored as vertex lists
};

/// Cuts polygons into fans from their first corner and splits vertices at every edge that is not
/// shared by exactly two oppositely directed triangles. Polygons with fewer than three corners,
/// with a repeated welded vertex, with the vertex set of an earlier polygon, or that would make the
/// fans non-manifold inside, are kept apart.
ManifoldMesh make_manifold(const Polygons& polygons, std::span<const uint32_t> welded);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_MANIFOLD_MESH_H_
