// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/sample_size.h"

#include "sdk/clip/sample.h"
#include "sdk/msgi/msgi_memory.h"
#include "sdk/play/play.h"

#include <algorithm>

namespace anicodec {
namespace {

/// Parts that are made of several frames: all of a blend may be.
constexpr uint64_t kMixedParts = Sample::kMaxParts;

SampleSize segment_size(const Segment& s) {
  SampleSize size;
  size.segments = 1;
  size.weights = mixed_floats(s);
  if (!s.msgi.empty()) {
    size.shapes = 1;
    size.shape = shape_size(s);
    size.scratch = sizeof(float) * shape_scratch_size(s);
  }
  return size;
}

SampleSize segment_size(const Limits::Segment& s, const Limits::Mesh& mesh, double quality) {
  const bool keyframes = s.kind == BasisKind::kKeyframes;
  SampleSize size;
  size.segments = 1;
  size.weights =
      s.regions * (uint64_t{keyframes ? s.components : wanted_components(quality, s.components)} *
                       traits_of(s.kind).weight_channels +
                   (keyframes ? 0 : 12));
  if (s.reconstruction == Reconstruction::kMsgi) {
    size.shapes = 1;
    size.shape = uint64_t{3} * mesh.coded_vertices;
    size.scratch = shape_scratch_bytes(s.components, msgi_frame_bytes(mesh));
  }
  return size;
}

}  // namespace

void SampleSize::include(const SampleSize& segment) {
  weights = std::max(weights, segment.weights);
  shape = std::max(shape, segment.shape);
  scratch = std::max(scratch, segment.scratch);
  segments += segment.segments;
  shapes += segment.shapes;
}

uint64_t SampleSize::buffer() const {
  return weights * std::min(segments, kMixedParts) +
         shape * std::min<uint64_t>(shapes, Sample::kMaxParts);
}

SampleSize sample_size(const Clip& clip, uint32_t track) {
  const Track& t = clip.tracks()[track];
  SampleSize size;
  for (uint32_t i = t.begin; i < t.end; ++i)
    size.include(segment_size(clip.segments()[clip.by_frame()[i]]));
  return size;
}

void ContextSize::add(const SampleSize& track) {
  ++tracks;
  buffers += track.buffer();
  scratch = std::max(scratch, track.scratch);
}

uint64_t ContextSize::bytes() const {
  return 2 * (sizeof(Sample) * tracks + sizeof(float) * buffers) + scratch;
}

ContextSize context_size(const Clip& clip) {
  ContextSize size;
  for (uint32_t t = 0; t < clip.tracks().size(); ++t)
    size.add(sample_size(clip, t));
  return size;
}

ContextSize context_size(const Limits& limits, double quality) {
  const Vector<uint32_t> order = limits.segments_by_frame();
  Vector<uint8_t> has_track(limits.meshes.size(), 0);
  ContextSize size;
  for (size_t i = 0; i < order.size();) {
    const Limits::Segment& first = limits.segments[order[i]];
    SampleSize track;
    for (; i < order.size() && limits.segments[order[i]].same_track(first); ++i)
      track.include(segment_size(limits.segments[order[i]], limits.meshes[first.mesh], quality));
    if (first.attribute == kPositions)
      has_track[first.mesh] = 1;
    size.add(track);
  }
  // A mesh that is in no frame has a track, too.
  for (uint8_t has : has_track) {
    if (!has)
      size.add({});
  }
  return size;
}

}  // namespace anicodec
