// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The series of chunk ROOT (spec/06-chunks.md, section 11). Written once for encoder and decoder.
#ifndef ANICODEC_SDK_CLIP_ROOT_CODING_H_
#define ANICODEC_SDK_CLIP_ROOT_CODING_H_

#include "format/memory.h"
#include "format/root_record.h"
#include "sdk/segment/series_coding.h"

#include <cstdint>

namespace anicodec {

/// Integers of a clip, one for each frame: two of the place on the ground, one of the turn. A
/// series that the clip does not hold is empty.
struct RootSeries {
  Vector<int32_t> moves[2];
  Vector<int32_t> turns;
};

/// Models shared by all clips of a file.
class RootCoding {
 public:
  /// Codes the series that a clip of `frames` frames holds. False when the stream ran out, or a
  /// value leaves the range of the format.
  template <class Coder>
  bool code(Coder& coder, uint8_t holds, size_t frames, RootSeries* series) {
    if (holds & RootRecord::kMoves) {
      for (Vector<int32_t>& s : series->moves) {
        if (!code(coder, moves_, frames, &s))
          return false;
      }
    }
    return !(holds & RootRecord::kTurns) || code(coder, turns_, frames, &series->turns);
  }

 private:
  template <class Coder>
  static bool code(Coder& coder, SeriesCoding& coding, size_t frames, Vector<int32_t>* series) {
    const int32_t order = Coder::kDecodes ? 0 : SeriesCoding::best_order(*series);
    return coding.code(coder, frames, order, series);
  }

  SeriesCoding moves_, turns_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_ROOT_CODING_H_
