// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_SURFACE_MATCH_H_
#define ANICODEC_CODEC_SURFACE_SURFACE_MATCH_H_

#include "codec/surface/surface.h"

namespace anicodec {

/// The largest opening: the longest diagonal of the box of a connected piece of the boundary, as a share of
/// the mesh's diagonal. 0 for a closed mesh. Cost: O(triangles).
double largest_opening(const SurfaceTopology& topology, const Positions& positions);

/// The largest opening of the open one of two meshes if the other is closed, as by a decimater that has
/// filled a hole; 0 if both are open or both closed. Throws Error(kInput) for an opening of more than a
/// twentieth of the diagonal.
double check_openings(const SurfaceTopology& mesh, const Positions& positions,
                      const Surface& surface);

/// Throws Error(kInput) if a mesh and a surface cannot stand for each other: as check_openings(), or
/// for a connected component of one that has no counterpart in the other, so that its
/// vertices are further from the other, on average, than a quarter of its own size. The surface has
/// an index. Cost: a query a vertex of both.
void check_surfaces_match(const SurfaceTopology& mesh, const Positions& positions,
                          const Surface& surface);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_SURFACE_MATCH_H_
