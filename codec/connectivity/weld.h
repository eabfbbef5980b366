// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_WELD_H_
#define ANICODEC_CODEC_CONNECTIVITY_WELD_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// Source vertices whose whole trajectories are bit-identical share one welded vertex: it is coded
/// once, and seams stay closed at any error.
struct Weld {
  std::vector<uint32_t> welded;          ///< welded vertex of each source vertex
  std::vector<uint32_t> representative;  ///< first source vertex of each welded vertex, ascending
};

/// Cost: O(vertices x frames), one pass over the positions, memory 16 bytes per vertex.
Weld weld_trajectories(const MeshSequence& sequence);

/// All vertices on their own: for meshes whose trajectories are yet to come.
Weld no_weld(uint32_t vertices);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_WELD_H_
