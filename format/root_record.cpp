// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/root_record.h"

#include <cmath>

namespace anicodec {

Bytes RootRecord::write() const {
  ByteWriter w;
  for (const Clip& clip : clips) {
    w.u8(clip.holds);
    if (clip.holds == 0)
      continue;
    w.f64(clip.pivot[0]);
    w.f64(clip.pivot[1]);
    if (clip.holds & kMoves)
      w.f64(clip.step);
    if (clip.holds & kTurns)
      w.f64(clip.turn_step);
  }
  w.raw(stream);
  return std::move(w.bytes());
}

Status RootRecord::read(ByteView view, const Limits& limits, RootRecord* out) {
  ByteReader r(view);
  // A clip takes at least a byte.
  if (limits.clip_frames.size() > r.remaining())
    return Status::kRecord;
  out->clips.assign(limits.clip_frames.size(), {});
  uint32_t frames = 0;
  bool finite = true, steps = true;
  for (size_t c = 0; c < out->clips.size(); ++c) {
    Clip& clip = out->clips[c];
    clip.holds = r.u8();
    if (clip.holds > (kMoves | kTurns))
      return Status::kRecord;
    if (clip.holds == 0)
      continue;
    frames += limits.clip_frames[c];
    for (double& x : clip.pivot) {
      x = r.f64();
      finite &= std::isfinite(x);
    }
    if (clip.holds & kMoves)
      clip.step = r.f64();
    if (clip.holds & kTurns)
      clip.turn_step = r.f64();
    for (double step : {clip.step, clip.turn_step})
      steps &= std::isfinite(step) && step > 0;
  }
  out->stream = r.raw(r.remaining());
  if (!r.ok() || frames != limits.root_frames)
    return Status::kRecord;
  return finite && steps ? Status::kOk : Status::kQuantizer;
}

}  // namespace anicodec
