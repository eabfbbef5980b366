// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_ROOT_MOTION_H_
#define ANICODEC_SDK_CLIP_ROOT_MOTION_H_

#include "format/records.h"
#include "format/root_record.h"
#include "format/status.h"
#include "sdk/clip/clock.h"
#include "sdk/clip/root_coding.h"
#include "sdk/segment/segment.h"

#include <cstdint>

namespace anicodec {

/// The axes of the ground: a turn leads from axis a to axis b, about the up axis.
struct GroundAxes {
  uint32_t a = 2, b = 0;

  /// By ClipsRecord::up; the y axis is up where nothing is known.
  static GroundAxes of(uint8_t up) { return up == 2 ? GroundAxes{0, 1} : GroundAxes{2, 0}; }
};

/// The motion of the whole at a time: x is turned about the pivot, then moved.
struct RootState {
  double turn = 0;  ///< radians; whole turns count
  double move[2] = {0, 0};
  double pivot[2] = {0, 0};

  Affine affine(const GroundAxes& axes) const;
};

/// Root motion of each clip (spec/06-chunks.md, section 11).
class RootMotion {
 public:
  /// Whether no clip has any.
  bool empty() const { return clips_.empty(); }

  GroundAxes axes() const { return axes_; }

  /// RootRecord::kMoves, kTurns, both or neither.
  uint8_t holds(uint32_t clip) const { return empty() ? uint8_t{0} : clips_[clip].holds; }

  /// Decodes the series. Series of clips that are not wanted are given back. `wanted`: by clip.
  /// Errors: those of chunk ROOT.
  Status open(ByteView payload, const Limits& limits, uint8_t up, const Vector<uint8_t>& wanted);

  /// Root motion at a frame, counted within the clip.
  RootState at(uint32_t clip, uint32_t frame) const;

  /// Calls visit(values, count) for each series.
  template <class Visit>
  void each_series(Visit visit) const {
    for (const RootSeries& s : series_) {
      for (const Vector<int32_t>* values : {&s.moves[0], &s.moves[1], &s.turns}) {
        if (!values->empty())
          visit(values->data(), values->size());
      }
    }
  }

  size_t resident_bytes() const;

 private:
  GroundAxes axes_;
  Vector<RootRecord::Clip> clips_;
  Vector<RootSeries> series_;  ///< by clip
};

/// One motion of several, with weights that sum to one: places and pivots linearly, turns on the
/// shorter way from that of the first.
RootState mean_root(const RootState* states, const double* weights, uint32_t count);

/// a after b.
Affine after(const Affine& a, const Affine& b);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_ROOT_MOTION_H_
