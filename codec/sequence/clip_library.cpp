// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/clip_library.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <string>
#include <utility>

namespace anicodec {
namespace {

[[noreturn]] void refuse(const MeshSequence& clip, const std::string& text) {
  throw Error(ErrorKind::kInput, "clip '" + clip.name + "': " + text);
}

void check_fits(const MeshSequence& first, const MeshSequence& next) {
  if (next.vertex_count != first.vertex_count)
    refuse(next, "has " + std::to_string(next.vertex_count) + " vertices, but '" + first.name +
                     "' has " + std::to_string(first.vertex_count));
  if (next.polygons != first.polygons)
    refuse(next, "has other faces than '" + first.name + "'");
  if (next.up != first.up || next.metres_per_unit != first.metres_per_unit ||
      next.origin != first.origin)
    refuse(next, "has another up axis, unit or origin than '" + first.name + "'");
  const bool fits = std::ranges::equal(
      next.attributes, first.attributes, [](const Attribute& a, const Attribute& b) {
        return a.kind == b.kind && a.name == b.name && a.domain == b.domain &&
               a.components == b.components;
      });
  if (!fits)
    refuse(next, "has other attributes than '" + first.name + "'");
}

/// The values of an attribute in all clips, once if none changes.
void join_attribute(const std::vector<MeshSequence>& clips, size_t number, uint32_t frames,
                    Attribute* out) {
  const bool moves = std::ranges::any_of(
      clips, [&](const MeshSequence& c) { return c.attributes[number].frames > 1; });
  if (!moves)
    return;
  out->frames = frames;
  out->values.clear();
  for (const MeshSequence& clip : clips) {
    const Attribute& own = clip.attributes[number];
    for (uint32_t f = 0; f < clip.frame_count; f += own.frames)
      out->values.insert(out->values.end(), own.values.begin(), own.values.end());
  }
}

}  // namespace

MeshSequence clip_library(std::vector<MeshSequence> clips) {
  if (clips.empty())
    throw Error(ErrorKind::kUsage, "there is no clip");
  uint64_t frames = 0;
  for (const MeshSequence& clip : clips) {
    check_fits(clips[0], clip);
    frames += clip.frame_count;
  }
  if (frames >= 1U << 24)
    throw Error(ErrorKind::kInput, "the clips have more than 2^24 - 1 frames together");
  FrameArray positions = std::move(clips[0].positions);
  MeshSequence library = clips[0];
  library.frame_count = static_cast<uint32_t>(frames);
  library.times.clear();
  for (size_t i = 0; i < library.attributes.size(); ++i)
    join_attribute(clips, i, library.frame_count, &library.attributes[i]);
  positions.reserve(size_t{3} * library.vertex_count * library.frame_count);
  for (MeshSequence& clip : clips) {
    positions.insert(positions.end(), clip.positions.begin(), clip.positions.end());
    clip.positions = {};
    library.clips.push_back({std::move(clip.name), clip.frame_count, clip.rate, clip.start_time,
                             std::move(clip.times), clip.loop, std::move(clip.events)});
  }
  library.positions = std::move(positions);
  return library;
}

}  // namespace anicodec
