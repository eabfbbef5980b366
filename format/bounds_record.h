// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The record of chunk BNDS: boxes of the frames of a segment (spec/06-chunks.md, section 13).
#ifndef ANICODEC_FORMAT_BOUNDS_RECORD_H_
#define ANICODEC_FORMAT_BOUNDS_RECORD_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"

#include <array>
#include <cstdint>

namespace anicodec {

/// An axis-aligned box in scene units; empty where low > high.
struct Box {
  std::array<float, 3> low, high;
};

/// Frames that share a box in files of this encoder: 61 bytes for 200 frames, half a per mille to two of a file
/// (`anicodec dump` of the clips of RESULTS.md).
inline constexpr uint32_t kFramesOfBox = 64;

/// Boxes of runs of frames, each in 255ths of a box around all.
struct BoundsRecord {
  uint32_t every = 0;  ///< frames that share a box, the last box fewer; 0: all share `all`
  Box all = {};
  /// Distances of the low, then of the high sides from those of `all`.
  Vector<std::array<uint8_t, 6>> boxes;

  /// The box of a frame of the segment, at least as large as what it was made from.
  Box of_frame(uint32_t frame) const;

  /// Takes the boxes of all frames; one box for every `shared` frames. @pre frames is not empty
  void set(const Vector<Box>& frames, uint32_t shared);

  /// A record of the size that set() makes, without boxes.
  static BoundsRecord unmeasured(uint32_t frames, uint32_t shared);

  /// Whether there are no boxes: neither set(), nor read.
  bool is_empty() const {
    return all.low == all.high && all.low[0] == 0 && all.low[1] == 0 && all.low[2] == 0;
  }

  Bytes write() const;
  /// `frames`: of the segment.
  static Status read(ByteView view, uint32_t frames, BoundsRecord* out);
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_BOUNDS_RECORD_H_
