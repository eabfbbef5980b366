// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_EXACT_ENCODE_H_
#define ANICODEC_CODEC_SEGMENT_EXACT_ENCODE_H_

#include "codec/sequence/frame_view.h"
#include "format/bytes.h"
#include "sdk/mesh/topology.h"

namespace anicodec {

/// Chunk DIFF: the positions of a segment's frames (coded vertices) bit for bit. Cost: O(frames x
/// vertices), and frames x 512 for the choice of what each is predicted from. Memory: three bytes
/// for each coordinate beside the frames, and a copy of those along one axis.
Bytes encode_exact(const FrameView& frames, const Topology& topology);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_EXACT_ENCODE_H_
