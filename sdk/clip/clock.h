// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_CLOCK_H_
#define ANICODEC_SDK_CLIP_CLOCK_H_

#include "format/records.h"

#include <cstdint>

namespace anicodec {

enum class Sampling : uint8_t { kStep, kLinear, kCubic };
enum class Wrap : uint8_t { kClamp, kLoop, kPingPong };

/// A time as a combination of frames: each at most once, the weights sum to one.
struct FrameMix {
  struct Term {
    uint32_t frame = 0;
    double weight = 1;
  };

  /// Moments of one time; four times can be blended.
  static constexpr uint32_t kOfTime = 4, kMost = 4 * kOfTime;

  uint32_t count = 0;
  Term terms[kMost];  ///< the first is the frame at the time or before it

  void add(uint32_t frame, double weight);

  /// Goes over to another mix by a share between 0 and 1: at 0 nothing changes, at 1 the result is
  /// `other`, and frames that both have with the same weight keep it, all to the last bit. False
  /// when there are too many frames; then nothing has changed.
  bool blend(const FrameMix& other, double share);
};

/// When the frames of a clip are, from its first frame on; frames are counted within the clip (spec/04-coordinates.md, section 2;
/// spec/10-seeking.md, section 2).
class Clock {
 public:
  /// `record` must outlive the clock; it has frames.
  explicit Clock(const ClipRecord& record) : record_(record), frames_(record.frames) {}

  /// Seconds from frame 0 on; frames behind the last count as the last.
  double time(uint32_t frame) const { return since_start(frame) - since_start(0); }

  /// When frame 0 is on the clock of the source, in seconds.
  double start() const { return record_.start_time + since_start(0); }

  /// Seconds of one turn of a loop: up to the next frame 0.
  double loop_duration() const;

  /// The frames that make up a time, which must be finite; 0 is frame 0. O(1), O(log frames) with a
  /// table of times.
  FrameMix at(double seconds, Sampling sampling, Wrap wrap) const;

 private:
  double since_start(uint32_t frame) const;
  double last_period() const;  ///< how long the last frame stays
  FrameMix smooth(uint32_t frame, double s, Wrap wrap) const;

  /// Frames before the loop begins again.
  uint32_t loop_frames() const { return record_.closed && frames_ > 1 ? frames_ - 1 : frames_; }

  const ClipRecord& record_;
  uint32_t frames_;
};

/// A time of a clip as a mix of frames of the file.
FrameMix mix_at(const ClipRecord& clip, double seconds, Sampling sampling, Wrap wrap);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_CLOCK_H_
