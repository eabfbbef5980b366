// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_NEIGHBOURS_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_NEIGHBOURS_H_

#include "format/memory.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// Neighbours of ranks as entropy_fuzz gives them to the model of coefficients, of one level after
/// the other: all before the rank's own level.
struct FuzzNeighbours {
  static constexpr uint32_t kStride = 8, kLevel = 24;

  explicit FuzzNeighbours(uint32_t vertices) {
    for (uint32_t v = 0; v < vertices; ++v) {
      const uint32_t first = v / kLevel * kLevel;
      if (v == first)
        levels.push_back(v);
      for (uint32_t a = 0; a < kStride; ++a)
        ranks.push_back(a < first ? static_cast<int32_t>((v * 7 + a * 5) % first) : -1);
    }
    levels.push_back(vertices);
  }

  std::vector<int32_t> ranks;
  Vector<uint32_t> levels;
};

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_NEIGHBOURS_H_
