// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CORPUS_SLIDING_H_
#define ANICODEC_CORPUS_SLIDING_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>

namespace anicodec::corpus {

/// Captured vertices that slide: in every frame, on its own, every vertex that is not on a boundary
/// moves along the surface by smooth noise of `edges` mean edge lengths (root mean square) and is
/// put back on the surface. The noise is averaged three times over the neighbours; where it would
/// turn or flatten a triangle it is halved, at last left out. Coordinates become multiples of
/// `grid`; 0 leaves them.
MeshSequence slide_vertices(const MeshSequence& sequence, double edges, double grid, uint64_t seed);

}  // namespace anicodec::corpus

#endif  // ANICODEC_CORPUS_SLIDING_H_
