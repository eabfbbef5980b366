// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_BASE_DISJOINT_SETS_H_
#define ANICODEC_SDK_BASE_DISJOINT_SETS_H_

#include "format/memory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace anicodec {

/// Disjoint sets of the numbers below `count`, with path halving (Tarjan and van Leeuwen 1984). The
/// root of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  uint32_t find(uint32_t x) {
    while (parent_[x] != x)
      x = parent_[x] = parent_[parent_[x]];
    return x;
  }

  /// Returns whether the sets of a and b were different ones.
  bool join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  Vector<uint32_t> parent_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_DISJOINT_SETS_H_
