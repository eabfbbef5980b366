// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_KEYFRAME_SEGMENT_H_
#define ANICODEC_SDK_SEGMENT_KEYFRAME_SEGMENT_H_

#include "format/memory.h"
#include "sdk/segment/segment.h"

#include <cstdint>

namespace anicodec {

/// Parameters of a segment of key-frames (thesis chapter 5; spec/09-reconstruction.md).
///
///   x(v, f) = M_f * (origin + step * sum_j w(f, j) * q(j, v))
///
/// q are integers, key-frame j on a grid; w are integers in units of 2^-weight_bits.
struct KeyframeParameters {
  bool sum_to_one = false;  ///< the weight of key-frame 0 is what the others leave of one
  bool rigid = false;       ///< there is a motion M_f
  double origin[3] = {0, 0, 0};
  double step = 1;
  uint8_t weight_bits = 12;
  uint8_t leaf_faces = 0;      ///< of a patch, when frames are rebuilt by MSGI; 0: they are not
  uint8_t rotation_bits = 16;  ///< quaternions are integers in units of 2^-rotation_bits
  double translation_step = 1;
  Vector<uint32_t> frames;   ///< of each key-frame in the segment, ascending
  Vector<uint32_t> parents;  ///< 0, or one more than the earlier key-frame it is coded against

  Bytes write() const;
  Status read(ByteView bytes, const Limits::Segment& sizes);
};

Status open_keyframe_segment(const SegmentRecord& record, const SegmentContext& context,
                             DecodedIntegers& integers, Segment* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_KEYFRAME_SEGMENT_H_
