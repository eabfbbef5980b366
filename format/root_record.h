// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_ROOT_RECORD_H_
#define ANICODEC_FORMAT_ROOT_RECORD_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/records.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

/// Chunk ROOT: the motion of the whole of each clip, taken out of its positions
/// (spec/06-chunks.md, section 11).
struct RootRecord {
  static constexpr uint8_t kMoves = 1;  ///< along the ground
  static constexpr uint8_t kTurns = 2;  ///< about the up axis

  struct Clip {
    uint8_t holds = 0;         ///< kMoves, kTurns, both or neither
    double pivot[2] = {0, 0};  ///< of the turn, on the ground, scene units
    double step = 1;           ///< kMoves: scene units
    double turn_step = 1;      ///< kTurns: radians

    /// How many series of integers it has.
    uint32_t series() const {
      return ((holds & kMoves) != 0 ? 2U : 0U) + ((holds & kTurns) != 0 ? 1U : 0U);
    }
  };

  Vector<Clip> clips;  ///< in the order of the file
  ByteView stream;     ///< the series of the clips, entropy-coded

  Bytes write() const;
  /// Reads as many clips as the limits announce, which hold Limits::root_frames frames.
  static Status read(ByteView view, const Limits& limits, RootRecord* out);
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_ROOT_RECORD_H_
