// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/learnt_segment.h"

#include "format/checksum.h"

namespace anicodec {

uint64_t LearntSegment::hash_of(const VertexOrder& order) {
  const auto hash = [](const auto& values) {
    return xxh64(
        {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(values[0])});
  };
  const uint64_t parts[] = {hash(order.order), hash(order.neighbours), hash(order.level_start),
                            static_cast<uint64_t>(order.neighbour_count)};
  return xxh64({reinterpret_cast<const uint8_t*>(parts), sizeof parts});
}

}  // namespace anicodec
