// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_ATTRIBUTE_VALUES_H_
#define ANICODEC_SDK_PLAY_ATTRIBUTE_VALUES_H_

#include "sdk/play/play.h"

#include <cstdint>

namespace anicodec {

/// Vertices whose values are made at a time.
inline constexpr uint32_t kValueRange = 16 * kBlock;

/// Adds share * play(state) of a segment of an attribute to the values of the vertices first ..
/// first + count - 1: `values` holds count x components. O(count x components of the segment).
/// Allocates nothing.
void add_motion(const FrameState& state, float share, uint32_t components, uint32_t first,
                uint32_t count, float* values);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_ATTRIBUTE_VALUES_H_
