// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/clip_record.h"

#include <algorithm>

namespace anicodec {

ClipsRecord clips_record(const MeshSequence& sequence, const FileOptions& options,
                         const std::vector<ClipGoal>& goals) {
  ClipsRecord record;
  record.encoder = options.encoder;
  record.up = static_cast<uint8_t>(sequence.up);
  record.order = options.order;
  record.metres_per_unit = sequence.metres_per_unit;
  std::copy(sequence.origin.begin(), sequence.origin.end(), record.origin);
  record.clips.clear();
  for (const ClipTiming& timing : clips_of(sequence)) {
    const ClipGoal& goal = goals[record.clips.size()];
    ClipRecord& clip = record.clips.emplace_back();
    clip.name = timing.name;
    clip.frames = timing.frame_count;
    clip.rate_numerator = timing.rate.numerator;
    clip.rate_denominator = timing.rate.denominator;
    clip.rate_assumed = timing.rate.assumed;
    clip.loop = timing.loop;
    clip.start_time = timing.start_time;
    clip.times.assign(timing.times.begin(), timing.times.end());
    for (const NamedTime& event : timing.events) {
      ClipEvent& stored = clip.events.emplace_back();
      stored.name = event.name;
      stored.seconds = event.seconds;
    }
    clip.massaged = options.surface_change.has_value();
    if (clip.massaged) {
      clip.surface_error = options.surface_change->max;
      clip.surface_error_mean = options.surface_change->mean;
    }
    clip.asked = goal.bound.metric;
    clip.asked_value = goal.bound.value;
    clip.diagonal = goal.diagonal;
  }
  record.place();
  return record;
}

}  // namespace anicodec
