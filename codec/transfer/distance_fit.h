// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_TRANSFER_DISTANCE_FIT_H_
#define ANICODEC_CODEC_TRANSFER_DISTANCE_FIT_H_

#include "codec/massage/rigid_shape.h"
#include "codec/massage/sliding_solver.h"
#include "codec/surface/surface.h"

namespace anicodec {

struct DistanceFitOptions {
  double first_stiffness = 1;     ///< of the mesh's own shape against the distance, at first
  double last_stiffness = 3e-5;   ///< and from a quarter of the rounds on
  double least_stiffness = 1e-6;  ///< to which it falls while the mean lags behind the maximum
  double first_along = 1e-2;      ///< what a move along the surface counts in one across it
  double last_along = 3e-4;  ///< the same at last, to which it falls from half of the rounds on
  int rounds = 120;
};

/// Moves the vertices of a mesh to where its polygons are as close to a surface as they can be, on
/// average and at most (thesis sections 3.2.3, 3.3.2). Vertices leave the surface where that
/// serves: minimises
///   stiffness * (energy of RigidShape) + mean over surface_samples() of distance^1.3,
/// of the mesh from the surface and of the surface from the mesh, by Gauss-Newton steps with
/// reweighting. Samples that are further off than about half the largest distance at the start gain
/// weight from round to round, as in Lawson's algorithm, and lose it again when they no longer are;
/// so does the direction of which the mean is larger. The stiffness falls while the mean lags
/// behind the maximum, each in parts of that at the start, and rises again when it no longer does.
/// In every fifth round distances are found by the index, else by walking; in those of the second
/// half triangles that have turned are turned again (untangle()). The result is the round whose
/// larger one of mean and maximum, in the same parts, is least. The shape has the
/// connectivity of `mesh`, the surface has an index. On all threads; the result does not depend on
/// their number. Cost a round: about 12 queries a vertex of either, and up to 100 passes over the
/// edges.
Convergence fit_distance(const SurfaceTopology& mesh, const RigidShape& shape,
                         const Surface& surface, const DistanceFitOptions& options, Positions* v);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_DISTANCE_FIT_H_
