// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: contexts, seeking, positions, bounds, and what a GPU needs.
#include "sdk/api/objects.h"
#include "sdk/play/attribute_values.h"
#include "sdk/play/value_output.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace anicodec {
namespace {

static_assert(sizeof(anic_correction) == sizeof(Segment::Correction) &&
              offsetof(anic_correction, vertex) == offsetof(Segment::Correction, vertex) &&
              offsetof(anic_correction, delta) == offsetof(Segment::Correction, delta));
static_assert(ANIC_MAX_PARTS == Sample::kMaxParts && ANIC_BLOCK_VERTICES == kBlock);

/// Vertices whose box is found at a time.
constexpr uint32_t kRange = 16 * kBlock;

constexpr anic_box kNothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

void include(const float* points, size_t count, anic_box* box) {
  for (size_t i = 0; i < count; ++i) {
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

/// The sample that a call is about, after checking what all of them check.
anic_status find_sample(const anic_context* context, uint32_t mesh, anic_when when,
                        const Sample** out) {
  if (!context || mesh >= context->asset->clip.meshes().size() ||
      (when != ANIC_WHEN_CURRENT && when != ANIC_WHEN_PREVIOUS))
    return ANIC_E_ARGUMENT;
  if (!context->chosen)
    return ANIC_E_STATE;
  *out = &context->states[when].samples[mesh];
  return (*out)->count > 0 ? ANIC_OK : ANIC_E_SEGMENT;
}

/// The attribute of vertices that a call is about, where the mesh is there.
anic_status find_attribute(const anic_context* context, uint32_t mesh, uint32_t attribute,
                           anic_when when, const MeshAttribute** out) {
  const Sample* sample = nullptr;
  const anic_status status = find_sample(context, mesh, when, &sample);
  if (status != ANIC_OK && status != ANIC_E_SEGMENT)
    return status;
  const Vector<MeshAttribute>& attributes = context->asset->clip.meshes()[mesh].attributes;
  if (attribute >= attributes.size() ||
      attributes[attribute].header.domain != AttributeDomain::kVertex)
    return ANIC_E_ARGUMENT;
  *out = &attributes[attribute];
  return status;
}

/// What a sample consists of.
uint32_t give_parts(const Clip& clip, const Sample& sample, anic_part* out) {
  for (uint32_t p = 0; p < sample.count; ++p) {
    const FrameState& state = sample.parts[p];
    out[p].segment = static_cast<uint32_t>(state.segment - clip.segments().data());
    out[p].share = sample.share[p];
    out[p].weights = state.weights;
    out[p].shape = state.shape;
    std::copy_n(state.pose_map.m, 12, out[p].pose_map);
    std::copy_n(state.motion.m, 12, out[p].motion);
    out[p].corrections = reinterpret_cast<const anic_correction*>(state.corrections);
    out[p].correction_count = state.correction_count;
  }
  return sample.count;
}

bool is_range(const Clip& clip, uint32_t mesh, uint32_t first, uint32_t count) {
  const uint32_t vertices = clip.vertex_count(mesh);
  return first <= vertices && count <= vertices - first;
}

/// Makes the current state the previous one, and `mix` the current one.
void choose(anic_context* context, const FrameMix& mix) {
  const Clip& clip = context->asset->clip;
  std::swap(context->states[ANIC_WHEN_CURRENT], context->states[ANIC_WHEN_PREVIOUS]);
  float* weights = context->states[ANIC_WHEN_CURRENT].weights;
  for (uint32_t t = 0; t < clip.tracks().size(); ++t) {
    context->states[ANIC_WHEN_CURRENT].samples[t] =
        make_sample(clip, t, mix, weights, context->scratch);
    weights += sample_buffer_size(clip, t);
  }
}

}  // namespace

Status check_output(const anic_output* out, uint32_t count, VertexOutput* result) {
  if (!out || out->format < ANIC_FORMAT_FLOAT32X3 || out->format > ANIC_FORMAT_SNORM16X4 ||
      (!out->data && count > 0))
    return Status::kArgument;
  result->data = out->data;
  result->format = static_cast<VertexFormat>(out->format);
  const size_t element = vertex_format_size(result->format);
  result->stride = out->stride == 0 ? element : out->stride;
  const bool scaled = out->format >= ANIC_FORMAT_FLOAT16X3;
  for (size_t c = 0; c < 3; ++c) {
    result->offset[c] = scaled ? out->offset[c] : 0;
    result->scale[c] = scaled && out->scale[c] != 0 ? out->scale[c] : 1;
  }
  if (!is_valid(*result))
    return Status::kArgument;
  // size >= stride * (count - 1) + element, without wrapping
  if (count > 0 &&
      (out->size < element || (out->size - element) / result->stride < size_t{count} - 1))
    return Status::kBufferSize;
  return Status::kOk;
}

size_t context_extra(const Clip& clip) {
  size_t bytes = 0, scratch = 0;
  for (uint32_t t = 0; t < clip.tracks().size(); ++t) {
    bytes += sizeof(Sample) + sizeof(float) * sample_buffer_size(clip, t);
    scratch = std::max(scratch, sample_scratch_size(clip, t));
  }
  return 2 * bytes + sizeof(float) * scratch;
}

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

void compute_boxes(anic_asset* asset) {
  const Clip& clip = asset->clip;
  const size_t row = size_t{clip.frame_count()} + 1;
  asset->boxes.assign(row * clip.meshes().size(), kNothing);
  for (const Segment& s : clip.segments()) {
    if (s.attribute != kPositions)
      continue;
    anic_box* boxes = asset->boxes.data() + row * s.mesh;
    Vector<float> shapes(4 * shape_size(s)), scratch(shape_scratch_size(s));
    for (uint32_t f = 0; f < s.frames;) {
      FrameState states[4];
      const uint32_t count = std::min(s.frames - f, 4U);
      for (uint32_t i = 0; i < count; ++i)
        states[i] = frame_state(s, f + i);
      for (uint32_t i = 0; i < count; ++i)
        make_shape(&states[i], shapes.data() + i * shape_size(s), scratch.data());
      bounding_boxes(states, count, boxes + s.first_frame + f);
      f += count;
    }
    for (uint32_t f = 0; f < s.frames; ++f)
      include(boxes[s.first_frame + f], &boxes[clip.frame_count()]);
  }
}

}  // namespace anicodec

using namespace anicodec;

anic_status anic_create_context(const anic_asset* asset, const anic_allocator* allocator,
                                anic_context** out) {
  if (out)
    *out = nullptr;
  if (!asset || !out || (allocator && !allocator->allocate != !allocator->release))
    return ANIC_E_ARGUMENT;
  auto make = [&]() -> Failure {
    // The asset's memory may be in use by other threads: only where it comes from is taken.
    Memory memory = allocator ? memory_of(allocator) : memory_of_object(asset);
    memory.held = memory.peak = 0;
    const Clip& clip = asset->clip;
    const size_t extra = context_extra(clip), tracks = clip.tracks().size();
    auto* context = create<anic_context>(memory, extra);
    context->asset = asset;
    context->extra = extra;
    auto* behind = reinterpret_cast<unsigned char*>(context + 1);
    for (anic_context::State& state : context->states) {
      state.samples = reinterpret_cast<Sample*>(behind);
      for (size_t t = 0; t < tracks; ++t)
        new (state.samples + t) Sample;
      behind += tracks * sizeof(Sample);
    }
    for (anic_context::State& state : context->states) {
      state.weights = reinterpret_cast<float*>(behind);
      for (uint32_t t = 0; t < tracks; ++t)
        behind += sizeof(float) * sample_buffer_size(clip, t);
    }
    context->scratch = reinterpret_cast<float*>(behind);
    *out = context;
    return {};
  };
  return c_status(guarded(make).status);
}

void anic_destroy_context(anic_context* context) {
  if (context)
    destroy(context, context->extra);
}

anic_status anic_seek_frame(anic_context* context, uint32_t frame) {
  if (!context)
    return ANIC_E_ARGUMENT;
  if (frame >= context->asset->clip.frame_count())
    return ANIC_E_FRAME_RANGE;
  FrameMix mix;
  mix.add(frame, 1);
  choose(context, mix);
  if (!context->chosen) {
    context->chosen = true;
    anic_forget_previous(context);
  }
  return ANIC_OK;
}

anic_status anic_seek_time(anic_context* context, double seconds, anic_sampling sampling,
                           anic_wrap wrap) {
  if (!context || !std::isfinite(seconds) || sampling < ANIC_SAMPLE_STEP ||
      sampling > ANIC_SAMPLE_CUBIC || wrap < ANIC_WRAP_CLAMP || wrap > ANIC_WRAP_PING_PONG)
    return ANIC_E_ARGUMENT;
  const Clip& clip = context->asset->clip;
  choose(context, Clock(clip.record(), clip.frame_count())
                      .at(seconds, static_cast<Sampling>(sampling), static_cast<Wrap>(wrap)));
  if (!context->chosen) {
    context->chosen = true;
    anic_forget_previous(context);
  }
  return ANIC_OK;
}

anic_status anic_forget_previous(anic_context* context) {
  if (!context)
    return ANIC_E_ARGUMENT;
  if (!context->chosen)
    return ANIC_E_STATE;
  const Clip& clip = context->asset->clip;
  const anic_context::State &from = context->states[ANIC_WHEN_CURRENT],
                            &to = context->states[ANIC_WHEN_PREVIOUS];
  size_t begin = 0;
  for (uint32_t t = 0; t < clip.tracks().size(); ++t) {
    const size_t count = sample_buffer_size(clip, t);
    std::copy_n(from.weights + begin, count, to.weights + begin);
    to.samples[t] = from.samples[t];
    // Weights that are the segment's stay where they are; interpolated ones and shapes move along.
    for (uint32_t p = 0; p < to.samples[t].count; ++p) {
      FrameState& part = to.samples[t].parts[p];
      for (const float** values : {&part.weights, &part.shape}) {
        if (*values >= from.weights + begin && *values < from.weights + begin + count)
          *values = to.weights + (*values - from.weights);
      }
    }
    begin += count;
  }
  return ANIC_OK;
}

anic_status anic_write_positions(const anic_context* context, uint32_t mesh, anic_when when,
                                 uint32_t first, uint32_t count, const anic_output* out) {
  const Sample* sample = nullptr;
  if (anic_status status = find_sample(context, mesh, when, &sample); status != ANIC_OK)
    return status;
  if (!is_range(context->asset->clip, mesh, first, count))
    return ANIC_E_ARGUMENT;
  VertexOutput output;
  if (Status status = check_output(out, count, &output); status != Status::kOk)
    return c_status(status);
  if (count > 0)
    sample->positions(first, count, output);
  return ANIC_OK;
}

anic_status anic_write_attribute(const anic_context* context, uint32_t mesh, uint32_t attribute,
                                 anic_when when, uint32_t first, uint32_t count,
                                 const anic_value_output* out) {
  const MeshAttribute* found = nullptr;
  if (anic_status status = find_attribute(context, mesh, attribute, when, &found);
      status != ANIC_OK)
    return status;
  const Clip& clip = context->asset->clip;
  if (!is_range(clip, mesh, first, count))
    return ANIC_E_ARGUMENT;
  const uint32_t components = found->header.components();
  ValueOutput output;
  if (Status status = ValueOutput::make(out, components, count, &output); status != Status::kOk)
    return c_status(status);
  const auto [begin, end] = clip.attribute_tracks(mesh, attribute);
  float values[kValueRange * kMaxAttributeComponents];
  for (uint32_t v = first; v < first + count; v += kValueRange) {
    const uint32_t n = std::min(first + count - v, kValueRange);
    std::copy_n(found->values.data() + size_t{components} * v, size_t{components} * n, values);
    for (uint32_t t = begin; t < end; ++t)
      context->states[when].samples[t].add_motion(components, v, n, values);
    output.store(values, n);
  }
  return ANIC_OK;
}

anic_status anic_write_frames(const anic_asset* asset, uint32_t mesh, const uint32_t* frames,
                              uint32_t frame_count, uint32_t first, uint32_t count,
                              const anic_output* outputs) {
  if (!asset || mesh >= asset->clip.meshes().size() || frame_count > ANIC_MAX_FRAMES ||
      (frame_count > 0 && (!frames || !outputs)) || !is_range(asset->clip, mesh, first, count))
    return ANIC_E_ARGUMENT;
  FrameState states[ANIC_MAX_FRAMES];
  VertexOutput to[ANIC_MAX_FRAMES];
  for (uint32_t f = 0; f < frame_count; ++f) {
    if (frames[f] >= asset->clip.frame_count())
      return ANIC_E_FRAME_RANGE;
    const Segment* segment = asset->clip.segment_at(mesh, frames[f]);
    if (!segment)
      return ANIC_E_SEGMENT;
    if (!segment->msgi.empty())
      return ANIC_E_STATE;
    states[f] = frame_state(*segment, frames[f] - segment->first_frame);
    if (Status status = check_output(&outputs[f], count, &to[f]); status != Status::kOk)
      return c_status(status);
  }
  if (count > 0)
    play(states, frame_count, first, count, to);
  return ANIC_OK;
}

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
  if (asset->boxes.empty())
    return ANIC_E_STATE;
  if (frame >= asset->clip.frame_count())
    return ANIC_E_FRAME_RANGE;
  *out = asset->boxes[(size_t{asset->clip.frame_count()} + 1) * mesh + frame];
  return is_empty(*out) ? ANIC_E_SEGMENT : ANIC_OK;
}

anic_status anic_get_clip_bounds(const anic_asset* asset, uint32_t mesh, anic_box* out) {
  if (!asset || !out || mesh >= asset->clip.meshes().size())
    return ANIC_E_ARGUMENT;
  if (asset->boxes.empty())
    return ANIC_E_STATE;
  const size_t row = size_t{asset->clip.frame_count()} + 1;
  *out = asset->boxes[row * mesh + row - 1];
  return is_empty(*out) ? ANIC_E_SEGMENT : ANIC_OK;
}

anic_status anic_get_parts(const anic_context* context, uint32_t mesh, anic_when when,
                           anic_part out[ANIC_MAX_PARTS], uint32_t* count) {
  const Sample* sample = nullptr;
  if (!out || !count)
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_sample(context, mesh, when, &sample); status != ANIC_OK)
    return status;
  *count = give_parts(context->asset->clip, *sample, out);
  return ANIC_OK;
}

anic_status anic_get_attribute_parts(const anic_context* context, uint32_t mesh, uint32_t attribute,
                                     uint32_t first_component, anic_when when,
                                     anic_part out[ANIC_MAX_PARTS], uint32_t* count) {
  const MeshAttribute* found = nullptr;
  if (!out || !count || first_component % 3 != 0)
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_attribute(context, mesh, attribute, when, &found);
      status != ANIC_OK)
    return status;
  if (first_component >= found->header.components())
    return ANIC_E_ARGUMENT;
  const Clip& clip = context->asset->clip;
  *count = 0;
  const auto [first, last] = clip.attribute_tracks(mesh, attribute);
  for (uint32_t t = first; t < last; ++t) {
    if (clip.tracks()[t].first_component == first_component)
      *count = give_parts(clip, context->states[when].samples[t], out);
  }
  return ANIC_OK;
}
