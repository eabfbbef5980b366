// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/mesh_sequence.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string_view>

namespace anicodec {

namespace {

void check_clips(const MeshSequence& sequence) {
  auto fail = [](const std::string& text) { throw Error(ErrorKind::kInput, text); };
  uint64_t frames = 0;
  std::set<std::string_view> names;
  for (const ClipTiming& clip : sequence.clips) {
    frames += clip.frame_count;
    if (clip.frame_count == 0)
      fail("clip '" + clip.name + "' has no frame");
    if (!names.insert(clip.name).second)
      fail("two clips have the name '" + clip.name + "'");
    if (!clip.times.empty() && clip.times.size() != clip.frame_count)
      fail("clip '" + clip.name + "': the table of times does not fit the number of frames");
  }
  if (!sequence.clips.empty() && frames != sequence.frame_count)
    fail("the clips do not have all frames of the sequence");
}

double diagonal(std::span<const float> positions) {
  if (positions.empty())
    return 0;
  double low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < positions.size(); ++i) {
    const auto x = static_cast<double>(positions[i]);
    low[i % 3] = std::min(low[i % 3], x);
    high[i % 3] = std::max(high[i % 3], x);
  }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

}  // namespace

std::vector<ClipTiming> clips_of(const MeshSequence& sequence) {
  if (!sequence.clips.empty())
    return sequence.clips;
  return {{sequence.name, sequence.frame_count, sequence.rate, sequence.start_time, sequence.times,
           sequence.loop, sequence.events}};
}

void add_event(const NamedTime& event, ClipTiming* clip) {
  const double last = clip->times.empty() ? (clip->frame_count - 1) / clip->rate.value()
                                          : clip->times.back() - clip->times.front();
  const double end = last + 1 / clip->rate.value();
  auto fail = [&](const std::string& text) {
    throw Error(ErrorKind::kUsage,
                "event '" + event.name + "' of clip '" + clip->name + "' " + text);
  };
  if (event.name.empty())
    fail("has no name");
  if (!(event.seconds >= 0 && event.seconds <= end))
    fail("is outside the clip");
  const auto place = std::ranges::upper_bound(clip->events, event.seconds, {}, &NamedTime::seconds);
  clip->events.insert(place, event);
}

void check(const MeshSequence& sequence) {
  auto fail = [](const std::string& text) { throw Error(ErrorKind::kInput, text); };
  if (sequence.frame_count == 0)
    fail("the sequence has no frame");
  if (sequence.vertex_count == 0)
    fail("the mesh has no vertex");
  if (sequence.vertex_count >= (1U << 31) || sequence.frame_count >= (1U << 24))
    fail("the sequence is too large: at most 2^31 - 1 vertices and 2^24 - 1 frames");
  size_t per_frame = size_t{sequence.vertex_count} * 3;
  if (sequence.positions.size() != per_frame * sequence.frame_count)
    fail("the positions do not fit the counts of vertices and frames");
  if (!sequence.times.empty() && sequence.times.size() != sequence.frame_count)
    fail("the table of times does not fit the number of frames");
  check_clips(sequence);
  const Polygons& polygons = sequence.polygons;
  if (polygons.offsets.empty() || polygons.offsets.back() != polygons.corners.size())
    fail("the polygon offsets do not fit the corners");
  for (size_t p = 0; p < polygons.size(); ++p) {
    for (uint32_t v : polygons[p]) {
      if (v >= sequence.vertex_count)
        fail("face " + std::to_string(p) + " uses vertex " + std::to_string(v) + " of " +
             std::to_string(sequence.vertex_count));
    }
  }
  auto bad = std::find_if(sequence.positions.begin(), sequence.positions.end(),
                          [](float x) { return !std::isfinite(x); });
  if (bad != sequence.positions.end()) {
    size_t i = static_cast<size_t>(bad - sequence.positions.begin());
    fail("frame " + std::to_string(i / per_frame) + ", vertex " +
         std::to_string(i % per_frame / 3) + ": the position is not finite");
  }
  for (const Attribute& attribute : sequence.attributes) {
    if (attribute.frames != 1 && attribute.frames != sequence.frame_count)
      fail(attribute.name + ": has values for " + std::to_string(attribute.frames) + " of " +
           std::to_string(sequence.frame_count) + " frames");
  }
}

double diagonal(const MeshSequence& sequence) {
  return diagonal(std::span<const float>(sequence.positions));
}

std::vector<double> clip_diagonals(const MeshSequence& sequence) {
  std::vector<double> diagonals;
  std::span<const float> rest(sequence.positions);
  for (const ClipTiming& clip : clips_of(sequence)) {
    const size_t size = size_t{3} * sequence.vertex_count * clip.frame_count;
    diagonals.push_back(diagonal(rest.first(size)));
    rest = rest.subspan(size);
  }
  return diagonals;
}

bool is_closed(const MeshSequence& sequence, const FrameRun& frames) {
  return frames.count > 1 && std::ranges::equal(sequence.frame(frames.first),
                                                sequence.frame(frames.first + frames.count - 1));
}

}  // namespace anicodec
