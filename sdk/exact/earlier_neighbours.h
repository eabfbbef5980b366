// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_EXACT_EARLIER_NEIGHBOURS_H_
#define ANICODEC_SDK_EXACT_EARLIER_NEIGHBOURS_H_

#include "format/memory.h"
#include "sdk/mesh/topology.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// For each coded vertex four vertices before it: the last ones that triangles join it to, in
/// descending order, from the first again where there are fewer than four; the vertex before it
/// where there is none. Vertex 0 has none. O(triangles).
class EarlierNeighbours {
 public:
  static constexpr uint32_t kCount = 4;

  explicit EarlierNeighbours(const Topology& topology);

  /// kCount vertices; @pre vertex > 0
  const uint32_t* of(uint32_t vertex) const { return vertices_.data() + size_t{kCount} * vertex; }

 private:
  void add(uint32_t vertex, uint32_t other);

  Vector<uint32_t> vertices_;  ///< coded vertices x kCount
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_EXACT_EARLIER_NEIGHBOURS_H_
