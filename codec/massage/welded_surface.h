// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_WELDED_SURFACE_H_
#define ANICODEC_CODEC_MASSAGE_WELDED_SURFACE_H_

#include "codec/connectivity/weld.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/surface/surface.h"

#include <span>

namespace anicodec {

/// The surface of a sequence: vertices with bit-identical trajectories are one, polygons are fans
/// of triangles. So seams of texture coordinates or normals are no boundaries.
struct WeldedSurface {
  /// The sequence has passed check().
  explicit WeldedSurface(const MeshSequence& sequence);

  /// Welded vertices x 3 of a frame of this sequence, or of another with its vertices.
  Positions frame(std::span<const float> positions) const;

  /// Writes welded vertices to all the vertices of a frame.
  void store(const Positions& welded, std::span<float> positions) const;

  Weld weld;
  SurfaceTopology topology;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_WELDED_SURFACE_H_
