// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_COMBINE_H_
#define ANICODEC_SDK_COMBINE_H_

#include "sdk/segment.h"

#include <cstdint>

namespace anicodec {

/// What of a segment depends on time, at one time: a frame is the segment's basis combined with it.
/// Points into the segment, or to what the caller interpolated.
struct FrameState {
  const Segment* segment = nullptr;
  const float* weights = nullptr;                    ///< components x weight_channels
  Affine pose_map;                                   ///< A_f, where the segment has a pose
  Affine motion;                                     ///< M_f, where the segment has motions
  const Segment::Correction* corrections = nullptr;  ///< ascending by vertex
  uint32_t correction_count = 0;
};

/// A whole frame, 0 .. frames - 1 of the segment. O(1).
FrameState frame_state(const Segment& segment, uint32_t frame);

/// Positions of the vertices first .. first + count - 1 of the segment, three floats each, without
/// gaps; written once, in order. Cost: O(count x components), the same for every frame. Allocates
/// nothing.
void combine(const FrameState& state, uint32_t first, uint32_t count, float* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_COMBINE_H_
