// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_ROOT_STEP_H_
#define ANICODEC_SDK_CLIP_ROOT_STEP_H_

#include "sdk/clip/clip.h"
#include "sdk/clip/clock.h"

#include <cstdint>

namespace anicodec {

/// The step of a character from one time of a clip to another, earlier or later: a turn, and a move
/// in the axes that the character has at `from`; no pivot. A loop goes on at its end from where it
/// is, and keeps its pace between its last frame and the next first one. Both times are finite, and
/// in a loop less than 2^52 turns apart. Cost: O(log frames + log turns).
RootState root_step(const Clip& clip, uint32_t number, double from, double to, Sampling sampling,
                    Wrap wrap);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_ROOT_STEP_H_
