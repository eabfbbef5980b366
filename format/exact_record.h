// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_EXACT_RECORD_H_
#define ANICODEC_FORMAT_EXACT_RECORD_H_

#include "format/bytes.h"
#include "format/records.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

/// Chunk DIFF: the positions of a segment bit for bit (spec/06-chunks.md, section 12).
struct ExactRecord {
  /// Numbers origin + k step, which the coordinates along an axis are, rounded, or are near: k is coded
  /// instead of a coordinate.
  struct Lattice {
    double origin = 0;
    double step = 0;  ///< 0: there is none
    int32_t first = 0;
    uint32_t count = 0;  ///< k is first .. first + count - 1
    bool errs = false;   ///< coordinates may be other numbers than the points

    bool is_used() const { return step > 0; }
  };

  Lattice lattices[3];  ///< by axis
  double noise = 1;     ///< variance that predictions are expected to miss by, scene units squared
  uint64_t hash = 0;    ///< IntegerHash of the bits of all coordinates, frame by frame
  ByteView stream;      ///< spec/09d-exact-positions.md

  Bytes write() const;
  /// A lattice that errs has no more points than the segment has positions.
  static Status read(ByteView view, const Limits::Segment& segment, const Limits::Mesh& mesh,
                     ExactRecord* out);
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_EXACT_RECORD_H_
