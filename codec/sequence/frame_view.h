// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_FRAME_VIEW_H_
#define ANICODEC_CODEC_SEQUENCE_FRAME_VIEW_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstddef>

namespace anicodec {

/// Positions of a clip, or of a range of its frames and vertices, without owning them: frame f has
/// vertex_count x 3 floats from frame(f) on. Valid as long as the floats are.
struct FrameView {
  const float* positions = nullptr;
  size_t frame_count = 0;
  size_t vertex_count = 0;
  size_t frame_stride = 0;  ///< floats from one frame to the next

  FrameView() = default;

  /// frame_count x vertex_count x 3 floats, row-major without gaps.
  FrameView(const float* data, size_t frames, size_t vertices)
      : positions(data), frame_count(frames), vertex_count(vertices), frame_stride(3 * vertices) {}

  explicit FrameView(const MeshSequence& sequence)
      : FrameView(sequence.positions.data(), sequence.frame_count, sequence.vertex_count) {}

  const float* frame(size_t f) const { return positions + f * frame_stride; }

  /// Frames first, first + step, ... (count of them); the caller keeps them in range.
  FrameView frames(size_t first, size_t count, size_t step = 1) const {
    FrameView part = *this;
    part.positions = frame(first);
    part.frame_count = count;
    part.frame_stride = frame_stride * step;
    return part;
  }

  /// Vertices first .. first + count - 1 of every frame; the caller keeps them in range.
  FrameView vertices(size_t first, size_t count) const {
    FrameView part = *this;
    part.positions += 3 * first;
    part.vertex_count = count;
    return part;
  }
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_FRAME_VIEW_H_
