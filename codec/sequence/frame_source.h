// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_FRAME_SOURCE_H_
#define ANICODEC_CODEC_SEQUENCE_FRAME_SOURCE_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace anicodec {

/// Gives the positions of a frame, vertices x 3. They stay valid until the next call of the same
/// source, so that a decoder may hand out one buffer again and again. Long computations ask for
/// frames 0, 1, 2, ... in order, each once.
using FrameSource = std::function<std::span<const float>(uint32_t frame)>;

/// Gives the attributes of a frame, each with the values of that frame alone.
using AttributeSource = std::function<std::vector<Attribute>(uint32_t frame)>;

/// The frames of a sequence, which must outlive the source.
inline FrameSource frames_of(const MeshSequence& sequence) {
  return [&sequence](uint32_t frame) { return sequence.frame(frame); };
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_FRAME_SOURCE_H_
