// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_SEGMENT_PLAYER_H_
#define ANICODEC_CODEC_SEGMENT_SEGMENT_PLAYER_H_

#include "sdk/play/play.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace anicodec {

/// Plays segments that belong to no clip yet. Keeps its memory from frame to frame.
class SegmentPlayer {
 public:
  /// Returns the positions of all vertices of a segment in its frame `frame`, three floats each; valid until the next
  /// call. Cost: that of a frame.
  const float* play(const Segment& segment, uint32_t frame) {
    shape_.resize(shape_size(segment));
    scratch_.resize(shape_scratch_size(segment));
    positions_.resize(size_t{3} * segment.vertices);
    FrameState state = frame_state(segment, frame);
    make_shape(&state, shape_.data(), scratch_.data());
    anicodec::play(state, 0, segment.vertices, positions_.data());
    return positions_.data();
  }

 private:
  std::vector<float> shape_, scratch_, positions_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_SEGMENT_PLAYER_H_
