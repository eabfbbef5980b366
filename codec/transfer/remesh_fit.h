// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Mesh Massage of one mesh (thesis section 3.3.2, remeshing): a coarse mesh comes to lie on a
// surface as well as its vertices allow.
#ifndef ANICODEC_CODEC_TRANSFER_REMESH_FIT_H_
#define ANICODEC_CODEC_TRANSFER_REMESH_FIT_H_

#include "codec/massage/sliding_solver.h"
#include "codec/metrics/hausdorff.h"
#include "codec/surface/mesh_quality.h"
#include "codec/surface/surface_frame.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct RemeshFit {
  FrameArray positions;  ///< of the mesh, vertices x 3
  HausdorffDistance before, after;
  double diagonal = 0;  ///< of the box around the surface
  RadiusRatio ratio_before, ratio_after;
  uint32_t turned_before = 0, turned_after = 0;  ///< triangles that face against the surface
  double opening = 0;                            ///< see check_openings(), in parts of a diagonal
  bool improved = false;  ///< if not, the positions are those that were given
  Convergence convergence;
};

/// Fits a mesh to a surface of any connectivity that it roughly covers already: fit_closely().
/// Vertices at the same place move together. If the mean distance did not fall or the largest one
/// grew, the mesh stays as it was. Throws Error(kInput) if a mesh has no triangles, and as
/// check_surfaces_match().
RemeshFit fit_remesh(const SurfaceFrame& mesh, const SurfaceFrame& surface);

/// The distances of a mesh from a surface as if it had been fitted in vain. Throws Error(kInput) if
/// one has no triangles.
RemeshFit measure_mesh(const SurfaceFrame& mesh, const SurfaceFrame& surface);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_REMESH_FIT_H_
