// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_REMESH_ISOTROPIC_H_
#define ANICODEC_CODEC_REMESH_ISOTROPIC_H_

#include "codec/remesh/sound_mesh.h"
#include "codec/sequence/progress.h"
#include "codec/surface/surface_frame.h"

#include <cstdint>

namespace anicodec {

struct IsotropicOptions {
  uint32_t vertices = 0;  ///< to be reached, within about a hundredth
  double crease = 60;     ///< degrees between the normals at an edge that is kept
  int rounds = 12;
};

/// Covers the surface with triangles of equal size (Botsch and Kobbelt, "A remeshing approach to
/// multiresolution modeling", SGP 2004): each round splits edges of more than 4/3 of a length,
/// collapses those of less than 4/5, flips edges towards valence 6, and moves vertices to the
/// middle of their neighbours and back to the surface. Boundaries and creases are only split and
/// shortened, and their corners stay. The length follows from the number of vertices and the area.
/// Cost: a closest point by walking for each vertex and round. Throws Error(kInput) as
/// sound_mesh(), and for a surface without area. Stage "remeshing". `repairs` may be null.
SurfaceFrame remesh_isotropic(const SurfaceFrame& mesh, const IsotropicOptions& options,
                              const Progress& progress = {}, MeshRepairs* repairs = nullptr);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_REMESH_ISOTROPIC_H_
