// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_JOINED_QUADS_H_
#define ANICODEC_TESTS_BENCH_JOINED_QUADS_H_

#include "codec/sequence/mesh_sequence.h"

namespace anicodec::bench {

/// The polygons of a clip with pairs of triangles joined to quads, the squarest in frame 0 first: about
/// what a mesh of quads was before it was cut into triangles.
Polygons join_triangles(const MeshSequence& sequence);

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_JOINED_QUADS_H_
