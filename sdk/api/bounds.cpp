// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: boxes.
#include "sdk/api/bounds.h"

#include "sdk/base/float_control.h"
#include "sdk/base/lanes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace anicodec {
namespace {

/// Vertices whose box is found at a time.
constexpr uint32_t kRange = 16 * kBlock;

constexpr anic_box kNothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/// The same for 4 n points: three vectors hold four of them, and each lane is always of one axis.
void include_fours(const float* points, size_t count, anic_box* box) {
  using Float = LaneTypes<4>::Float;
  constexpr size_t kLanes = 12;
  float low[kLanes], high[kLanes];
  for (size_t i = 0; i < kLanes; ++i) {
    low[i] = box->min[i % 3];
    high[i] = box->max[i % 3];
  }
  Float least[3], most[3];
  std::memcpy(least, low, sizeof low);
  std::memcpy(most, high, sizeof high);
  for (size_t i = 0; i < count; i += 4) {
    Float p[3];
    std::memcpy(p, points + 3 * i, sizeof p);
    for (size_t v = 0; v < 3; ++v) {
      least[v] = p[v] < least[v] ? p[v] : least[v];
      most[v] = p[v] > most[v] ? p[v] : most[v];
    }
  }
  std::memcpy(low, least, sizeof low);
  std::memcpy(high, most, sizeof high);
  for (size_t i = 0; i < kLanes; ++i) {
    box->min[i % 3] = std::min(box->min[i % 3], low[i]);
    box->max[i % 3] = std::max(box->max[i % 3], high[i]);
  }
}

void include(const float* points, size_t count, anic_box* box) {
  const size_t fours = count / 4 * 4;
  include_fours(points, fours, box);
  for (size_t i = fours; i < count; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      box->min[c] = std::min(box->min[c], points[3 * i + c]);
      box->max[c] = std::max(box->max[c], points[3 * i + c]);
    }
  }
}

void include(const anic_box& other, anic_box* box) {
  include(other.min, 1, box);
  include(other.max, 1, box);
}

bool is_empty(const anic_box& box) {
  return box.min[0] > box.max[0];
}

/// The boxes of positions in states, which are of one mesh; as many as play() likes.
void bounding_boxes(const FrameState* states, uint32_t frames, anic_box* out) {
  constexpr uint32_t kFrames = 4;
  float points[kFrames][3 * kRange];
  for (uint32_t f = 0; f < frames; f += kFrames) {
    const uint32_t together = std::min(frames - f, kFrames);
    VertexOutput outputs[kFrames];
    for (uint32_t i = 0; i < together; ++i) {
      outputs[i].data = points[i];
      out[f + i] = kNothing;
    }
    const uint32_t vertices = states[f].segment->vertices;
    for (uint32_t v = 0; v < vertices; v += kRange) {
      const uint32_t count = std::min(vertices - v, kRange);
      play(states + f, together, v, count, outputs);
      for (uint32_t i = 0; i < together; ++i)
        include(points[i], count, &out[f + i]);
    }
  }
}

/// Frames after which the host is asked whether to go on.
constexpr uint32_t kBatch = 64;

/// The boxes of frames first .. last - 1 of a segment. Shapes of MSGI are made in `memory`.
void segment_boxes(const Clip& clip, const Segment& s, uint32_t first, uint32_t last,
                   Vector<float>* memory, anic_box* out) {
  const FloatControl control;
  constexpr uint32_t kFrames = 4;
  for (uint32_t f = first; f < last; f += kFrames) {
    FrameState states[kFrames];
    const uint32_t count = std::min(last - f, kFrames);
    for (uint32_t i = 0; i < count; ++i) {
      states[i] = clip.state_of(s, f + i);
      if (!s.msgi.empty())
        make_shape(&states[i], memory->data() + i * shape_size(s),
                   memory->data() + kFrames * shape_size(s));
    }
    bounding_boxes(states, count, out + f);
  }
}

/// Bounds of all frames of a segment. Segments of MSGI need memory, which only this thread takes.
bool segment_boxes(const Clip& clip, const Segment& s, const HostThreads& threads,
                   HostProgress* progress, anic_box* out) {
  Vector<float> memory(4 * shape_size(s) + shape_scratch_size(s));
  for (uint32_t first = 0; first < s.frames; first += kBatch) {
    const uint32_t count = std::min(s.frames - first, kBatch);
    auto work = [&](size_t begin, size_t end) {
      segment_boxes(clip, s, first + static_cast<uint32_t>(begin),
                    first + static_cast<uint32_t>(end), &memory, out);
    };
    for_ranges(s.msgi.empty() ? threads : HostThreads{}, count, 4, work);
    if (!progress->advance(count))
      return false;
  }
  return true;
}

}  // namespace

bool compute_boxes(OpenedFile* file, const HostThreads& threads, HostProgress* progress) {
  const Clip& clip = file->clip;
  const size_t row = size_t{clip.frame_count()} + 1;
  file->boxes.assign(row * clip.meshes().size(), kNothing);
  double frames = 0;
  for (const Segment& s : clip.segments())
    frames += s.attribute == kPositions ? s.frames : 0;
  progress->begin(frames);
  for (const Segment& s : clip.segments()) {
    if (s.attribute != kPositions)
      continue;
    anic_box* boxes = file->boxes.data() + row * s.mesh;
    if (!segment_boxes(clip, s, threads, progress, boxes + s.first_frame))
      return false;
    for (uint32_t f = 0; f < s.frames; ++f)
      include(boxes[s.first_frame + f], &boxes[clip.frame_count()]);
  }
  return true;
}

}  // namespace anicodec

using namespace anicodec;

anic_status anic_compute_bounds(const anic_context* context, uint32_t mesh, anic_when when,
                                anic_box* out) {
  const Sample* sample = nullptr;
  if (!out)
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_sample(context, mesh, when, &sample); status != ANIC_OK)
    return status;
  if (sample->count == 1) {
    bounding_boxes(sample->parts, 1, out);
    return ANIC_OK;
  }
  *out = kNothing;
  float points[3 * kRange];
  VertexOutput output;
  output.data = points;
  const uint32_t vertices = context->asset->clip.vertex_count(mesh);
  for (uint32_t v = 0; v < vertices; v += kRange) {
    const uint32_t count = std::min(vertices - v, kRange);
    sample->positions(v, count, output);
    include(points, count, out);
  }
  return ANIC_OK;
}

anic_status anic_get_frame_bounds(const anic_asset* asset, uint32_t mesh, uint32_t frame,
                                  anic_box* out) {
  if (!asset || !out || mesh >= asset->clip.meshes().size())
    return ANIC_E_ARGUMENT;
  if (asset->file->boxes.empty())
    return ANIC_E_STATE;
  if (frame >= asset->clip.frame_count())
    return ANIC_E_FRAME_RANGE;
  if (!asset->has_clip(asset->clip.clip_at(frame)))
    return ANIC_E_ABSENT;
  *out = asset->file->boxes[(size_t{asset->clip.frame_count()} + 1) * mesh + frame];
  return is_empty(*out) ? ANIC_E_ABSENT : ANIC_OK;
}

anic_status anic_get_clip_bounds(const anic_asset* asset, uint32_t mesh, anic_box* out) {
  if (!asset || !out || mesh >= asset->clip.meshes().size())
    return ANIC_E_ARGUMENT;
  if (asset->file->boxes.empty())
    return ANIC_E_STATE;
  const size_t row = size_t{asset->clip.frame_count()} + 1;
  *out = asset->file->boxes[row * mesh + row - 1];
  return is_empty(*out) ? ANIC_E_ABSENT : ANIC_OK;
}
