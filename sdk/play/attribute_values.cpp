// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/attribute_values.h"

#include <algorithm>

namespace anicodec {

void add_motion(const FrameState& state, float share, uint32_t components, uint32_t first,
                uint32_t count, float* values) {
  const uint32_t at = state.segment->first_component;
  const uint32_t width = std::min(components - at, 3U);
  float offsets[3 * kValueRange];
  for (uint32_t done = 0; done < count;) {
    const uint32_t n = std::min(count - done, kValueRange);
    play(state, first + done, n, offsets);
    for (uint32_t i = 0; i < n; ++i) {
      float* to = values + size_t{components} * (done + i) + at;
      for (uint32_t c = 0; c < width; ++c)
        to[c] += share * offsets[3 * i + c];
    }
    done += n;
  }
}

}  // namespace anicodec
