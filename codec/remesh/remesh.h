// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_REMESH_REMESH_H_
#define ANICODEC_CODEC_REMESH_REMESH_H_

#include "codec/remesh/sound_mesh.h"
#include "codec/sequence/progress.h"
#include "codec/surface/surface_frame.h"
#include "codec/transfer/remesh_fit.h"

#include <cstdint>
#include <string>

namespace anicodec {

enum class RemeshMethod : uint8_t {
  kAuto,       ///< kDecimate for fewer vertices, kIsotropic for more
  kDecimate,   ///< a part of the vertices: large triangles where the surface is flat
  kIsotropic,  ///< triangles of equal size
  kLoop,       ///< smooth: Loop subdivision, decimated to the number
};

struct RemeshOptions {
  uint32_t vertices = 0;    ///< of the result; 0: as few as max_distance allows, by kDecimate
  double max_distance = 0;  ///< of decimation, scene units; 0: any (see DecimationOptions)
  RemeshMethod method = RemeshMethod::kAuto;
  bool fit = true;  ///< move the vertices to where the result is closest to the surface
};

struct RemeshResult {
  SurfaceFrame mesh;  ///< triangles
  RemeshMethod method = RemeshMethod::kDecimate;
  MeshRepairs repairs;
  RemeshFit fit;       ///< distances from the surface before and after fitting
  std::string no_fit;  ///< why the mesh could not be fitted; empty if it was, or was not asked to
};

/// Another connectivity for a surface (thesis section 3.3.2): changes the number of vertices, then
/// fits the result to the surface with fit_remesh(). For kLoop the surface is the subdivided one.
/// Reaches the number exactly unless the shape does not allow it: a closed component keeps four
/// vertices, creases and boundaries keep their corners. Attributes and labels are not kept. Throws
/// as decimate(), remesh_isotropic() and subdivide().
RemeshResult remesh(const SurfaceFrame& mesh, const RemeshOptions& options,
                    const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_REMESH_REMESH_H_
