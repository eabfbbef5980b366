// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_TRANSFER_CLOSE_FIT_H_
#define ANICODEC_CODEC_TRANSFER_CLOSE_FIT_H_

#include "codec/massage/sliding_solver.h"
#include "codec/surface/surface.h"

namespace anicodec {

/// Moves the vertices of a mesh that is near a surface to where mean and largest distance of the
/// two, both ways, are least (thesis sections 3.2.3, 3.3.2); both are those of hausdorff(). Descends
/// by damped Gauss-Newton steps (Levenberg and Marquardt) on
///   the larger mean, in parts of that at the start
///   + weight * sum over samples of max(0, distance - 0.57 of the largest at the start)^2,
/// whose distances are found anew after every step; a step that does not lower it is taken back and
/// damped more. The weight grows while something is further off. Vertices may leave the surface. A
/// weak RigidShape of the start, which fades, keeps triangles from degenerating. Triangles that are
/// turned at the start are turned again (untangle()), and vertices whose triangles a step would
/// turn go less far: after some rounds only while nothing is further off than 0.6 of the largest, as
/// folds of a surface hold them for ever. The result is the round, of every tenth and with no more turned
/// triangles than at the start, whose larger part of mean and maximum is below 0.6, with the fewest turned triangles, and
/// of these the least part; if none is below the start in both, it is the start. While it is above 0.6 the descent is made
/// again, up to four times, in turns from what is best and from where the last one ended, its triangles turned back. The surface
/// has an index. On all threads; the result does not depend on their number. Cost: up to 150 rounds a descent, each of 12
/// queries a vertex of either side and up to 100 passes over the edges, sometimes several times.
Convergence fit_closely(const SurfaceTopology& mesh, const Surface& surface, Positions* v);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_CLOSE_FIT_H_
