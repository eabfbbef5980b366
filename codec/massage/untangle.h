// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_UNTANGLE_H_
#define ANICODEC_CODEC_MASSAGE_UNTANGLE_H_

#include "codec/surface/surface.h"

#include <cstdint>

namespace anicodec {

/// Flips triangles of a mesh that face against a surface of the same connectivity
/// (turned_in_place()) back by the smallest move of their corners. Repeats, up to 40 times, for
/// triangles that this turns. If that goes in circles, the neighbourhood is evened out on the
/// surface and moved again; this is kept if it halves the number of turned triangles. Positions
/// become those of floats. Moves inner vertices alone. Triangles still turned then are left to
/// limit_distance(). Returns the number of triangles it turned. Cost: that of turned_in_place() and
/// little more.
uint32_t untangle(const Surface& surface, Positions* v);

/// The same for a mesh of another connectivity than the surface, which has an index, and what
/// turned_triangles() finds.
uint32_t untangle(const SurfaceTopology& mesh, const Surface& surface, Positions* v);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_UNTANGLE_H_
