// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Maps between two meshes with little distortion (thesis section 3.3.3).
#ifndef ANICODEC_CODEC_TRANSFER_CROSS_PARAMETRISATION_H_
#define ANICODEC_CODEC_TRANSFER_CROSS_PARAMETRISATION_H_

#include "codec/surface/mesh_quality.h"
#include "codec/surface/surface.h"
#include "codec/transfer/registration.h"

#include <vector>

namespace anicodec {

struct CrossParametrisationOptions {
  double lambda = 0.1;  ///< of distance against shape, in (0, 1)
  int rounds = 20;
  double tolerance = 1e-2;  ///< stop when the root mean square step is below so many mean edges
  std::vector<Landmark> landmarks;  ///< vertices of the mesh and where they belong on the surface
};

/// A map from a mesh to a surface, linear on every triangle.
struct CrossParametrisation {
  Positions positions;               ///< of the mesh's vertices, on the surface
  std::vector<SurfacePoint> points;  ///< the same as points of the surface
  Distortion before, after;          ///< of the map from the mesh's own shape
  uint32_t turned = 0;               ///< triangles that face against the surface
  Convergence convergence;
};

/// Improves a rough map: `rough` holds where the mesh's vertices lie on or near the surface. Mean
/// value weights of the mesh's own positions `shape` ask for its angles, so the map comes near a
/// conformal one; landmarks stay where they are told to be. The surface has an index and any
/// connectivity. Throws as check_openings(), and Error(kUsage) for a landmark that is no vertex.
CrossParametrisation improve_map(const SurfaceTopology& mesh, const Positions& shape,
                                 const Surface& surface, const Positions& rough,
                                 const CrossParametrisationOptions& options);

/// A rough map from landmarks alone, at least three that are not on a line: the mesh is laid onto
/// them by the best similarity and deformed onto the surface by Registration. Without landmarks the
/// mesh must lie over the surface as it is. Throws as improve_map(), and Error(kUsage) for too few
/// landmarks.
Positions map_by_landmarks(const SurfaceTopology& mesh, const Positions& shape,
                           const Surface& surface, const std::vector<Landmark>& landmarks);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_CROSS_PARAMETRISATION_H_
