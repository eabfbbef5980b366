// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_TRANSFER_MESH_MAP_H_
#define ANICODEC_CODEC_TRANSFER_MESH_MAP_H_

#include "codec/metrics/hausdorff.h"
#include "codec/surface/mesh_quality.h"
#include "codec/surface/surface_frame.h"
#include "codec/surface/surface_topology.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// A vertex of a mesh and the vertex of a surface that it is mapped to.
struct VertexPair {
  uint32_t mesh = 0, surface = 0;
};

/// A point of a polygon mesh: on a triangle of the fan of one of its polygons.
struct MeshPoint {
  uint32_t polygon = 0;
  uint32_t corners[3] = {};  ///< numbers in Polygons::corners
  double weights[3] = {};    ///< of these corners; they sum to one
};

struct MeshMap {
  FrameArray positions;           ///< of the mesh's vertices on the surface, vertices x 3
  std::vector<MeshPoint> points;  ///< the same as points of the surface, one for each vertex
  /// For each corner of the mesh's polygons, a point on the triangle of the surface below the
  /// polygon at this corner: values on either side of a seam of the surface stay apart. Weights
  /// below zero lie beyond that triangle.
  std::vector<MeshPoint> corners;
  Distortion before, after;    ///< of the rough map and of the result, from the mesh's own shape
  uint32_t turned = 0;         ///< triangles that face against the surface
  HausdorffDistance distance;  ///< between the result and the surface
  double diagonal = 0;         ///< of the surface
  bool converged = false;
};

/// Gives a mesh the shape of a surface of any connectivity (thesis section 3.3.3): a rough map by
/// at least three landmarks that are not on a line, improved towards a conformal one. Without
/// landmarks the two must lie over each other, and the rough map is a registration. Seams of equal
/// positions are welded. Cost: some 30 rounds of registration and 20 of fitting, each a query for
/// every vertex. Throws Error(kInput) for meshes without triangles and as check_openings(), and Error(kUsage) for a landmark that is no vertex or for too few of them.
MeshMap map_mesh(const SurfaceFrame& mesh, const SurfaceFrame& surface,
                 std::span<const VertexPair> landmarks);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_MESH_MAP_H_
