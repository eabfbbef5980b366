// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_REMESH_DECIMATE_H_
#define ANICODEC_CODEC_REMESH_DECIMATE_H_

#include "codec/remesh/sound_mesh.h"
#include "codec/sequence/progress.h"
#include "codec/surface/surface_frame.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct DecimationOptions {
  uint32_t vertices = 0;    ///< to be left; 0: as few as max_distance allows
  double max_distance = 0;  ///< of a removed vertex from the new surface, scene units; 0: any
};

struct Decimation {
  SurfaceFrame mesh;  ///< triangles
  /// Vertices of the mesh given that are left; a place may be there twice.
  std::vector<uint32_t> vertices;
  MeshRepairs repairs;
};

/// Removes vertices by half-edge collapses, cheapest quadric error first (Garland and Heckbert
/// 1997; along boundaries with the quadrics of planes across them), so that those left keep their
/// positions. No collapse turns a triangle by more than 60 degrees, unless the number of vertices
/// cannot be reached otherwise; then by up to 85. Stops early where nothing more can be removed: a
/// closed component keeps four vertices, an open one three. The distance is OpenMesh's Hausdorff
/// module: of removed vertices, not of the surface between them. Cost: O(n log n) for vertices of
/// bounded valence. Throws Error(kInput) as sound_mesh(), Error(kUsage) if neither option is given.
/// Stage "decimating".
Decimation decimate(const SurfaceFrame& mesh, const DecimationOptions& options,
                    const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_REMESH_DECIMATE_H_
