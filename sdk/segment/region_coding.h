// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The region of each vertex (spec/09a-segments.md, section 3.6). Written once for encoder and decoder.
#ifndef ANICODEC_SDK_SEGMENT_REGION_CODING_H_
#define ANICODEC_SDK_SEGMENT_REGION_CODING_H_

#include "format/coding/binary_coder.h"
#include "format/memory.h"
#include "format/records.h"
#include "sdk/prediction/mesh_graph.h"

#include <algorithm>
#include <cstdint>

namespace anicodec {

/// Codes the regions of all vertices, each a number below `count`, by those of the neighbours that
/// come before a vertex: borders alone cost more than next to nothing. False when the stream ran
/// out. Cost: O(vertices x count + edges).
class RegionCoding {
 public:
  RegionCoding(const MeshGraph& graph, uint32_t count) : graph_(graph), count_(count) {}

  /// `regions` has as many entries as the graph has vertices.
  template <class Coder>
  bool code(Coder& coder, Vector<uint8_t>* regions) {
    for (uint32_t v = 0; v < regions->size(); ++v) {
      uint32_t seen[kMaxRegions] = {};
      const uint32_t total = look_around(*regions, v, seen);
      uint8_t& region = (*regions)[v];
      const auto likely =
          static_cast<uint32_t>(std::max_element(seen, seen + count_) - seen);  // the first
      const uint32_t most = std::min(seen[likely], kMostSeen);
      const uint32_t others = std::min(total - seen[likely], kMostSeen);
      region = coder.bit(same_[most][others], region == likely)
                   ? static_cast<uint8_t>(likely)
                   : code_other(coder, likely, seen, region);
      if constexpr (Coder::kDecodes) {
        if (!coder.ok())
          return false;
      }
    }
    return true;
  }

 private:
  static constexpr uint32_t kMostSeen = 3;

  /// How often each region is among the neighbours before v, or that of the vertex before it where
  /// there are none.
  uint32_t look_around(const Vector<uint8_t>& regions, uint32_t v, uint32_t* seen) const {
    uint32_t total = 0;
    const uint32_t end = graph_.is_dense() ? 0 : graph_.start()[v + 1];
    for (uint32_t e = graph_.is_dense() ? 0 : graph_.start()[v]; e < end; ++e) {
      const uint32_t u = graph_.adjacent()[e];
      if (u < v) {
        ++seen[regions[u]];
        ++total;
      }
    }
    if (total == 0 && v > 0) {
      ++seen[regions[v - 1]];
      ++total;
    }
    return total;
  }

  /// A region that is not the likely one; the last one that is left takes no decision.
  template <class Coder>
  uint8_t code_other(Coder& coder, uint32_t likely, const uint32_t* seen, uint32_t region) {
    const uint32_t last = likely + 1 == count_ ? count_ - 2 : count_ - 1;
    uint32_t r = likely == 0 ? 1 : 0;
    while (r != last && !coder.bit(is_[r][seen[r] > 0], region == r))
      r += r + 1 == likely ? 2 : 1;
    return static_cast<uint8_t>(r);
  }

  const MeshGraph& graph_;
  uint32_t count_;
  AdaptiveBit same_[kMostSeen + 1][kMostSeen + 1];
  AdaptiveBit is_[kMaxRegions][2];
};

/// Block `pose` of a linear segment: the region of each of the graph's vertices; none where there is
/// one region. Errors: kEntropy; kRecord: one region, and bytes.
inline Status read_regions(ByteView bytes, const MeshGraph& graph, uint32_t count,
                           Vector<uint8_t>* regions) {
  if (count == 1)
    return bytes.size == 0 ? Status::kOk : Status::kRecord;
  regions->resize(graph.vertex_count());
  BinaryDecoder decoder(bytes.data, bytes.size);
  return RegionCoding(graph, count).code(decoder, regions) && decoder.finish() ? Status::kOk
                                                                               : Status::kEntropy;
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_REGION_CODING_H_
