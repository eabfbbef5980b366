// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Logarithmic classes of magnitudes, as contexts (spec/08-entropy.md, section 4).
#ifndef ANICODEC_FORMAT_CODING_MAGNITUDE_CLASS_H_
#define ANICODEC_FORMAT_CODING_MAGNITUDE_CLASS_H_

#include "format/coding/symbol_model.h"
#include "format/compiler.h"

#include <cstdint>

namespace anicodec {

/// 1 << kPerOctaveBits classes per octave, one per value at the start: 0, 1, 2, ... At most count
/// - 1.
template <int kPerOctaveBits>
ANICODEC_INLINE constexpr uint32_t magnitude_class(uint32_t x) {
  if (x < (1u << kPerOctaveBits))
    return x;
  const int e = floor_log2(x) - kPerOctaveBits;
  return (static_cast<uint32_t>(e) << kPerOctaveBits) + (x >> e);
}

template <int kPerOctaveBits>
ANICODEC_INLINE constexpr uint32_t magnitude_class(uint32_t x, uint32_t count) {
  const uint32_t c = magnitude_class<kPerOctaveBits>(x);
  return c < count ? c : count - 1;
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_MAGNITUDE_CLASS_H_
