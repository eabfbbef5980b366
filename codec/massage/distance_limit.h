// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_DISTANCE_LIMIT_H_
#define ANICODEC_CODEC_MASSAGE_DISTANCE_LIMIT_H_

#include "codec/surface/surface.h"

namespace anicodec {

/// Draws moved vertices back towards where they were, each by halves and only as far as needed,
/// until the moved surface and the original one are nowhere further apart than `limit` (which may
/// be infinite), both ways, at the vertices, edge mid-points and triangle centres of either, and no
/// moved triangle has turned (turned_in_place()). Vertices that are drawn back have float positions.
/// `original` has an index; `v` has its connectivity, vertex for vertex. Returns how many vertices
/// it drew back.
uint32_t limit_distance(const Surface& original, double limit, Positions* v);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_DISTANCE_LIMIT_H_
