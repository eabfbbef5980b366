// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_KEEP_FRAMES_H_
#define ANICODEC_SDK_SEGMENT_KEEP_FRAMES_H_

#include "sdk/segment/segment.h"

#include <cstdint>

namespace anicodec {

/// Makes an opened segment one of its frames first .. first + count - 1 alone: the weights,
/// matrices and corrections of others are given back, and with them the components of linear bases
/// that rest in all frames kept. The kept frames play as before, to the last bit. Cost: O(what is
/// resident).
void keep_frames(uint32_t first, uint32_t count, Segment* segment);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_KEEP_FRAMES_H_
