// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_SURFACE_MATCH_H_
#define ANICODEC_CODEC_SURFACE_SURFACE_MATCH_H_

#include "codec/surface/surface.h"

namespace anicodec {

/// Throws Error(kInput) if a mesh and a surface cannot stand for each other: one is open and the
/// other closed, or a connected component of one has no counterpart in the other, so that its
/// vertices are further from the other, on average, than a quarter of its own size. The surface has
/// an index. Cost: a query a vertex of both.
void check_surfaces_match(const SurfaceTopology& mesh, const Positions& positions,
                          const Surface& surface);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_SURFACE_MATCH_H_
