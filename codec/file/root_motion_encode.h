// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_ROOT_MOTION_ENCODE_H_
#define ANICODEC_CODEC_FILE_ROOT_MOTION_ENCODE_H_

#include "codec/sequence/mesh_sequence.h"
#include "format/bytes.h"

#include <cstdint>

namespace anicodec {

/// The motion of the whole of each clip, coded.
struct EncodedRoot {
  Bytes chunk;          ///< ROOT; empty: nothing moves as a whole
  uint32_t frames = 0;  ///< of the clips that have any
};

/// Takes the motion of the whole out of the positions: in each clip the way of the mean of the
/// vertices along the ground, and the turn about the up axis that fits the first frame best (least
/// squares in the plane), on a grid of some 1e-5 of `diagonal`. The first frame of a clip stays as
/// it is; where the axis is unknown, y is up. O(vertices x frames). Throws Error(kInput) naming the clip
/// that moves further than the format holds.
EncodedRoot take_root_motion(double diagonal, MeshSequence* sequence);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_ROOT_MOTION_ENCODE_H_
