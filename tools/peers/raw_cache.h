// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_PEERS_RAW_CACHE_H_
#define ANICODEC_TOOLS_PEERS_RAW_CACHE_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>

namespace anicodec::peers {

/// Sizes of a vertex cache, float32 positions frame after frame, through general compressors.
struct RawCacheSize {
  uint64_t raw = 0;   ///< bytes, uncompressed
  uint64_t zstd = 0;  ///< level 19
  uint64_t xz = 0;    ///< preset 9
};

/// Nothing is lost, and faces are not counted. Cost: some seconds per 10 MB, on one thread each.
RawCacheSize raw_cache_size(const MeshSequence& sequence);

}  // namespace anicodec::peers

#endif  // ANICODEC_TOOLS_PEERS_RAW_CACHE_H_
