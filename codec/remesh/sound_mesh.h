// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_REMESH_SOUND_MESH_H_
#define ANICODEC_CODEC_REMESH_SOUND_MESH_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/surface/surface.h"
#include "codec/surface/surface_topology.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// How a mesh differs from the one that was given.
struct MeshRepairs {
  uint32_t degenerate = 0;  ///< triangles with a repeated vertex, left out
  uint32_t repeated = 0;    ///< triangles with the corners of an earlier one, left out
  uint32_t parted = 0;      ///< vertices added where faces touched in a vertex only

  bool any() const { return degenerate + repeated + parted > 0; }
};

/// A mesh on which an algorithm of half-edges can rely: at most two triangles at an edge, wound
/// alike, and one fan of triangles at a vertex.
struct SoundMesh {
  std::vector<SurfaceTopology::Triangle> triangles;
  std::vector<uint32_t> source;  ///< vertex of the sequence that each vertex stands for
  MeshRepairs repairs;

  /// vertices x 3 of a frame of the sequence.
  Positions frame(std::span<const float> positions) const;
};

/// Cuts polygons into triangles as in the first frame (triangulated()), welds vertices with bit-identical trajectories (seams of texture
/// coordinates are no boundaries) unless a non-manifold edge came of it, leaves out unused vertices
/// and degenerate and repeated triangles, and parts fans that share a vertex only. Cost:
/// O(triangles log triangles). Throws Error(kInput) for a mesh without faces, an edge of three
/// faces or more and an edge of which the two faces are wound unlike, naming its vertices.
SoundMesh sound_mesh(const MeshSequence& sequence);

/// Positions moved and scaled into a box of diagonal 1 around the origin, so that no threshold of a
/// library depends on units.
class UnitBox {
 public:
  explicit UnitBox(const Positions& positions);

  Positions to_box(const Positions& positions) const;
  Positions from_box(const Positions& positions) const;

  double diagonal() const { return diagonal_; }  ///< of the box around the positions

 private:
  Eigen::RowVector3d centre_;
  double diagonal_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_REMESH_SOUND_MESH_H_
