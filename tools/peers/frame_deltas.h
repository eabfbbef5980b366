// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_PEERS_FRAME_DELTAS_H_
#define ANICODEC_TOOLS_PEERS_FRAME_DELTAS_H_

#include "tools/peers/cubic_grid.h"

#include <cstdint>
#include <span>
#include <string>

namespace anicodec::peers {

struct FrameDeltaSize {
  uint64_t bytes = 0;   ///< of positions and connectivity
  std::string variant;  ///< the one that is smallest
};

/// Size of a clip as meshoptimizer and zstd store it: differences of each frame's grid positions to
/// the frame before through meshoptimizer's vertex codec, a buffer per frame, triangles through its
/// index codec, all that through zstd -19. The smallest of four variants: vertices in the order
/// given or in the order of use after meshopt_optimizeVertexCache, differences in two's complement
/// or folded; 16 bits where the grid allows, else 32. A fast level of zstd selects the variant.
FrameDeltaSize frame_delta_size(const GriddedClip& clip, uint32_t vertex_count,
                                std::span<const uint32_t> triangles);

}  // namespace anicodec::peers

#endif  // ANICODEC_TOOLS_PEERS_FRAME_DELTAS_H_
