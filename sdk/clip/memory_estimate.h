// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_MEMORY_ESTIMATE_H_
#define ANICODEC_SDK_CLIP_MEMORY_ESTIMATE_H_

#include "format/records.h"

#include <cstdint>

namespace anicodec {

/// How much a file takes, known from its limits alone (spec/11-limits.md, section 3). Values that
/// 64 bits cannot hold are UINT64_MAX.
struct MemoryEstimate {
  uint64_t resident = 0;  ///< bytes while a clip is open
  uint64_t opening = 0;   ///< bytes at most while it opens, the resident ones included
  uint64_t draco = 0;     ///< of those, at most, what Draco takes by itself
  uint64_t kept = 0;      ///< bytes more, at most, of an opening with KeptMeshes, these included
};

/// `quality` as in OpenOptions; `exact`: whether exact positions are opened. O(meshes + segments).
MemoryEstimate estimate_memory(const Limits& limits, double quality = 1, bool exact = true);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_MEMORY_ESTIMATE_H_
