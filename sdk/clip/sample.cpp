// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/sample.h"

#include "sdk/play/attribute_values.h"
#include "sdk/segment/rotation.h"

#include <algorithm>

namespace anicodec {
namespace {

/// Vertices whose parts are added up at a time.
constexpr uint32_t kRange = 16 * kBlock;

/// Frames of one segment, with weights that sum to one.
struct Group {
  const Segment* segment = nullptr;
  double share = 0;
  int count = 0;
  uint32_t frames[FrameMix::kMost];  ///< of the segment
  double weights[FrameMix::kMost];
};

/// The mean of `count` numbers in a row of each frame, rows `row` floats apart.
void add_up(const Group& group, const float* rows, size_t row, size_t count, float* out) {
  for (size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (int t = 0; t < group.count; ++t)
      sum += group.weights[t] * double{rows[group.frames[t] * row + i]};
    out[i] = static_cast<float>(sum);
  }
}

Affine mean_motion(const Group& group, const Vector<Affine>& motions) {
  UnitQuaternion rotations[FrameMix::kMost];
  double translation[3] = {0, 0, 0};
  for (int t = 0; t < group.count; ++t) {
    const Affine& motion = motions[group.frames[t]];
    rotations[t] = rotation_of(motion);
    for (int i = 0; i < 3; ++i)
      translation[i] += group.weights[t] * double{motion.m[4 * i + 3]};
  }
  return motion_of(mean_rotation(rotations, group.weights, group.count), translation);
}

FrameState mean_state(const Group& group, uint32_t components, float* weights) {
  const Segment& s = *group.segment;
  const size_t n = region_weights(s), played = size_t{components} * s.weight_channels();
  FrameState state;
  state.segment = &s;
  state.components = components;
  state.weights = weights;
  for (size_t r = 0; r < s.regions; ++r)
    add_up(group, s.weights.data() + r * n, s.regions * n, played, weights + r * n);
  if (!s.pose_maps.empty()) {
    const size_t maps = size_t{12} * s.regions;
    add_up(group, s.pose_maps[0].m, maps, maps, weights + s.regions * n);
    state.pose_maps = weights + s.regions * n;
  }
  state.moves = !s.motions.empty();
  if (state.moves)
    state.motion = mean_motion(group, s.motions);
  return state;
}

/// Calls use(sample of one frame of a track), if the track has the frame.
template <class Use>
void with_sample(const Clip& clip, uint32_t track, uint32_t frame, Use use) {
  const Segment* segment = clip.segment_at(track, frame);
  if (!segment)
    return;
  FrameMix mix;
  mix.add(frame, 1);
  Vector<float> shape(shape_size(*segment)), scratch(shape_scratch_size(*segment));
  use(make_sample(clip, track, mix, shape.data(), scratch.data()));
}

}  // namespace

size_t mixed_floats(const Segment& segment) {
  return segment.regions * (region_weights(segment) + (segment.pose_maps.empty() ? 0 : 12));
}

RootState root_state(const Clip& clip, const FrameMix& mix) {
  RootState states[FrameMix::kMost];
  double weights[FrameMix::kMost];
  for (uint32_t t = 0; t < mix.count; ++t) {
    states[t] = clip.root_at(mix.terms[t].frame);
    weights[t] = mix.terms[t].weight;
  }
  return mean_root(states, weights, mix.count);
}

uint32_t part_count(const Clip& clip, uint32_t track, const FrameMix& mix) {
  const Segment* found[FrameMix::kMost];
  uint32_t count = 0;
  for (uint32_t t = 0; t < mix.count; ++t) {
    const Segment* segment = clip.segment_at(track, mix.terms[t].frame);
    if (segment && mix.terms[t].weight != 0 &&
        std::find(found, found + count, segment) == found + count)
      found[count++] = segment;
  }
  return count;
}

Sample make_sample(const Clip& clip, uint32_t track, const FrameMix& mix, float* buffer,
                   float* scratch, double quality) {
  const bool is_attribute = clip.tracks()[track].is_attribute();
  Group groups[Sample::kMaxParts];
  uint32_t count = 0;
  double total = 0;
  for (uint32_t t = 0; t < mix.count; ++t) {
    const FrameMix::Term& term = mix.terms[t];
    const Segment* segment = clip.segment_at(track, term.frame);
    if (!segment && t == 0 && !is_attribute)
      return {};
    if (!segment || term.weight == 0)
      continue;
    uint32_t g = 0;
    while (g < count && groups[g].segment != segment)
      ++g;
    if (g == Sample::kMaxParts)
      continue;  // part_count() tells before
    count = std::max(count, g + 1);
    Group& group = groups[g];
    group.segment = segment;
    group.frames[group.count] = term.frame - segment->first_frame;
    group.weights[group.count++] = term.weight;
    group.share += term.weight;
    total += term.weight;
  }
  if (is_attribute)
    total = 1;
  Sample sample;
  for (uint32_t g = 0; g < count; ++g) {
    Group& group = groups[g];
    sample.share[g] = static_cast<float>(group.share / total);
    if (group.count == 1) {
      sample.parts[g] = frame_state(*group.segment, group.frames[0]);
      sample.parts[g].components = played_components(*group.segment, quality);
      if (mix.count > 1)
        sample.parts[g].correction_count = 0;
      if (mix.count > 1 || sample.parts[g].components < group.segment->components ||
          !clip.shows_exact(mix.terms[0].frame))
        sample.parts[g].exact = nullptr;
      continue;
    }
    for (int t = 0; t < group.count; ++t)
      group.weights[t] /= group.share;
    sample.parts[g] = mean_state(group, played_components(*group.segment, quality), buffer);
    buffer += mixed_floats(*group.segment);
  }
  if (!is_attribute && clip.has_root()) {
    const Affine root = root_state(clip, mix).affine(clip.root().axes());
    for (uint32_t g = 0; g < count; ++g)
      move_whole(root, &sample.parts[g]);
  }
  for (uint32_t g = 0; g < count; ++g) {
    make_shape(&sample.parts[g], buffer, scratch);
    buffer += shape_size(*groups[g].segment);
  }
  sample.count = count;
  return sample;
}

void Sample::add_motion(uint32_t components, uint32_t first, uint32_t vertices,
                        float* values) const {
  for (uint32_t p = 0; p < count; ++p)
    anicodec::add_motion(parts[p], share[p], components, first, vertices, values);
}

void Sample::positions(uint32_t first, uint32_t vertices, const VertexOutput& output) const {
  if (count == 1) {
    play(parts, 1, first, vertices, &output);
    return;
  }
  VertexOutput rest = output;
  for (uint32_t end = first + vertices; first < end;) {
    const uint32_t base = first / kRange * kRange;
    const uint32_t stop = std::min(end, base + kRange), n = stop - first;
    float sum[3 * kRange] = {}, part[3 * kRange];
    for (uint32_t p = 0; p < count; ++p) {
      play(parts[p], first, n, part);
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t v = first - base + i;
        for (uint32_t c = 0; c < 3; ++c)
          sum[(v / kBlock * 3 + c) * kBlock + v % kBlock] += share[p] * part[3 * i + c];
      }
    }
    store_points(sum, first - base, n, rest);
    rest.data = static_cast<unsigned char*>(rest.data) + rest.stride * n;
    first = stop;
  }
}

Status show_positions(const Clip& clip, uint32_t mesh, uint32_t frame, float* out) {
  if (frame >= clip.frame_count())
    return Status::kFrameRange;
  Status status = Status::kAbsent;
  with_sample(clip, mesh, frame, [&](const Sample& sample) {
    VertexOutput output;
    output.data = out;
    sample.positions(0, clip.vertex_count(mesh), output);
    status = Status::kOk;
  });
  return status;
}

Status show_attribute(const Clip& clip, uint32_t mesh, uint32_t attribute, uint32_t frame,
                      float* out) {
  if (frame >= clip.frame_count())
    return Status::kFrameRange;
  if (mesh >= clip.meshes().size() || attribute >= clip.meshes()[mesh].attributes.size() ||
      clip.meshes()[mesh].attributes[attribute].header.components() == 0)
    return Status::kArgument;
  const MeshAttribute& still = clip.meshes()[mesh].attributes[attribute];
  const uint32_t elements = still.header.elements(clip.limits().meshes[mesh]);
  std::copy(still.values.begin(), still.values.end(), out);
  const auto [first, last] = clip.attribute_tracks(mesh, attribute);
  for (uint32_t t = first; t < last; ++t) {
    with_sample(clip, t, frame, [&](const Sample& sample) {
      sample.add_motion(still.header.components(), 0, elements, out);
    });
  }
  return Status::kOk;
}

}  // namespace anicodec
