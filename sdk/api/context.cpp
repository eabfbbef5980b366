// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: contexts, seeking, positions, and values of attributes.
#include "sdk/api/objects.h"
#include "sdk/clip/root_step.h"
#include "sdk/play/attribute_values.h"
#include "sdk/play/value_output.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace anicodec {
namespace {

bool is_range(const Clip& clip, uint32_t mesh, uint32_t first, uint32_t count) {
  const uint32_t vertices = clip.vertex_count(mesh);
  return first <= vertices && count <= vertices - first;
}

/// Makes `mix` the current state.
void show(anic_context* context, const FrameMix& mix) {
  const Clip& clip = context->asset->clip;
  context->mix = mix;
  anic_context::State& state = context->states[ANIC_WHEN_CURRENT];
  state.root = root_state(clip, mix);
  state.holds = 0;
  for (uint32_t t = 0; t < mix.count; ++t)
    state.holds |= clip.root().holds(clip.clip_at(mix.terms[t].frame));
  float* weights = context->states[ANIC_WHEN_CURRENT].weights;
  // Another asset of the file may want clips that this one does not.
  const bool wanted = context->asset->has_clip(clip.clip_at(mix.terms[0].frame));
  const double quality = context->quality * context->asset->quality;
  for (uint32_t t = 0; t < clip.tracks().size(); ++t) {
    context->states[ANIC_WHEN_CURRENT].samples[t] =
        wanted ? make_sample(clip, t, mix, weights, context->scratch, quality) : Sample();
    weights += context->asset->file->buffers[t];
  }
}

/// Makes the current state the previous one, and `mix` the current one.
void choose(anic_context* context, const FrameMix& mix) {
  std::swap(context->states[ANIC_WHEN_CURRENT], context->states[ANIC_WHEN_PREVIOUS]);
  show(context, mix);
}

FrameMix mix_at(const ClipRecord& clip, double seconds, anic_sampling sampling, anic_wrap wrap) {
  return mix_at(clip, seconds, static_cast<Sampling>(sampling), static_cast<Wrap>(wrap));
}

void give_root(const Clip& clip, const RootState& root, uint8_t holds, anic_root_motion* host) {
  const GroundAxes axes = GroundAxes::of(clip.record().up);
  const Affine map = root.affine(axes);
  anic_root_motion filled = ANIC_INIT(anic_root_motion);
  filled.moves = (holds & RootRecord::kMoves) != 0;
  filled.turns = (holds & RootRecord::kTurns) != 0;
  filled.turn = root.turn;
  filled.move[axes.a] = root.move[0];
  filled.move[axes.b] = root.move[1];
  filled.pivot[axes.a] = root.pivot[0];
  filled.pivot[axes.b] = root.pivot[1];
  std::copy_n(map.m, 12, filled.matrix);
  give(filled, host);
}

bool is_time(double seconds, anic_sampling sampling, anic_wrap wrap) {
  return std::isfinite(seconds) && sampling >= ANIC_SAMPLE_STEP && sampling <= ANIC_SAMPLE_CUBIC &&
         wrap >= ANIC_WRAP_CLAMP && wrap <= ANIC_WRAP_PING_PONG;
}

}  // namespace

anic_status find_sample(const anic_context* context, uint32_t mesh, anic_when when,
                        const Sample** out) {
  if (!context || mesh >= context->asset->clip.meshes().size() ||
      (when != ANIC_WHEN_CURRENT && when != ANIC_WHEN_PREVIOUS))
    return ANIC_E_ARGUMENT;
  if (!context->chosen)
    return ANIC_E_STATE;
  *out = &context->states[when].samples[mesh];
  return (*out)->count > 0 ? ANIC_OK : ANIC_E_ABSENT;
}

anic_status find_attribute(const anic_context* context, uint32_t mesh, uint32_t attribute,
                           anic_when when, const MeshAttribute** out) {
  const Sample* sample = nullptr;
  const anic_status status = find_sample(context, mesh, when, &sample);
  if (status != ANIC_OK && status != ANIC_E_ABSENT)
    return status;
  const Vector<MeshAttribute>& attributes = context->asset->clip.meshes()[mesh].attributes;
  if (attribute >= attributes.size() || attributes[attribute].header.components() == 0)
    return ANIC_E_ARGUMENT;
  *out = &attributes[attribute];
  return status;
}

Status check_output(const anic_output* host, uint32_t count, VertexOutput* result) {
  anic_output ours;
  if (!host || !take(host, &ours))
    return Status::kArgument;
  const anic_output* out = &ours;
  if (out->format < ANIC_FORMAT_FLOAT32X3 || out->format > ANIC_FORMAT_SNORM16X4 ||
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
  if (count <= 1)
    result->stride = element;  // no step is taken: a huge one would lead past every address
  return Status::kOk;
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
    const size_t extra = asset->file->context_bytes - object_bytes<anic_context>();
    const size_t tracks = asset->clip.tracks().size();
    auto* context = create<anic_context>(memory, extra);
    context->asset = asset;
    context->extra = extra;
    while (!asset->has_clip(context->clip))
      ++context->clip;
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
        behind += sizeof(float) * asset->file->buffers[t];
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

anic_status anic_set_clip(anic_context* context, uint32_t clip) {
  if (!context || clip >= context->asset->clip.clips().size())
    return ANIC_E_ARGUMENT;
  if (!context->asset->has_clip(clip))
    return ANIC_E_ABSENT;
  context->clip = clip;
  return ANIC_OK;
}

anic_status anic_set_quality(anic_context* context, double quality) {
  if (!context || !(quality > 0 && quality <= 1))
    return ANIC_E_ARGUMENT;
  context->quality = quality;
  return ANIC_OK;
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
  if (!context || !is_time(seconds, sampling, wrap))
    return ANIC_E_ARGUMENT;
  choose(context, mix_at(context->asset->clip.clips()[context->clip], seconds, sampling, wrap));
  if (!context->chosen) {
    context->chosen = true;
    anic_forget_previous(context);
  }
  return ANIC_OK;
}

anic_status anic_blend(anic_context* context, uint32_t clip, double seconds, anic_sampling sampling,
                       anic_wrap wrap, double weight) {
  if (!context || clip >= context->asset->clip.clips().size() ||
      !is_time(seconds, sampling, wrap) || !(weight >= 0 && weight <= 1))
    return ANIC_E_ARGUMENT;
  if (!context->chosen)
    return ANIC_E_STATE;
  const Clip& asset = context->asset->clip;
  if (!context->asset->has_clip(clip))
    return ANIC_E_ABSENT;
  FrameMix mix = context->mix;
  if (!mix.blend(mix_at(asset.clips()[clip], seconds, sampling, wrap), weight))
    return ANIC_E_LIMIT;
  for (uint32_t t = 0; t < asset.tracks().size(); ++t) {
    if (part_count(asset, t, mix) > Sample::kMaxParts)
      return ANIC_E_LIMIT;
  }
  show(context, mix);
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
  context->states[ANIC_WHEN_PREVIOUS].root = from.root;
  context->states[ANIC_WHEN_PREVIOUS].holds = from.holds;
  size_t begin = 0;
  for (uint32_t t = 0; t < clip.tracks().size(); ++t) {
    const size_t count = context->asset->file->buffers[t];
    std::copy_n(from.weights + begin, count, to.weights + begin);
    to.samples[t] = from.samples[t];
    // Weights that are the segment's stay where they are; interpolated ones and shapes move along.
    for (uint32_t p = 0; p < to.samples[t].count; ++p) {
      FrameState& part = to.samples[t].parts[p];
      for (const float** values : {&part.weights, &part.pose_maps, &part.shape}) {
        if (*values >= from.weights + begin && *values < from.weights + begin + count)
          *values = to.weights + (*values - from.weights);
      }
    }
    begin += count;
  }
  return ANIC_OK;
}

anic_status anic_get_root_motion(const anic_asset* asset, uint32_t clip, double seconds,
                                 anic_sampling sampling, anic_wrap wrap, anic_root_motion* out) {
  if (clip >= anic_get_clip_count(asset) || !is_sized(out) || !is_time(seconds, sampling, wrap))
    return ANIC_E_ARGUMENT;
  const Clip& file = asset->clip;
  if (!asset->has_clip(clip))
    return ANIC_E_ABSENT;
  const FrameMix mix = mix_at(file.clips()[clip], seconds, sampling, wrap);
  give_root(file, root_state(file, mix), file.root().holds(clip), out);
  return ANIC_OK;
}

anic_status anic_get_root_step(const anic_asset* asset, uint32_t clip, double from, double to,
                               anic_sampling sampling, anic_wrap wrap, anic_root_motion* out) {
  constexpr double kMostTurns = 4503599627370496;  // 2^52
  if (clip >= anic_get_clip_count(asset) || !is_sized(out) || !is_time(from, sampling, wrap) ||
      !is_time(to, sampling, wrap))
    return ANIC_E_ARGUMENT;
  const Clip& file = asset->clip;
  const double loop = Clock(file.clips()[clip]).loop_duration();
  if (wrap == ANIC_WRAP_LOOP && std::max(std::abs(from), std::abs(to)) > kMostTurns / 2 * loop)
    return ANIC_E_ARGUMENT;
  if (!asset->has_clip(clip))
    return ANIC_E_ABSENT;
  const RootState step =
      root_step(file, clip, from, to, static_cast<Sampling>(sampling), static_cast<Wrap>(wrap));
  give_root(file, step, file.root().holds(clip), out);
  return ANIC_OK;
}

anic_status anic_get_shown_root_motion(const anic_context* context, anic_when when,
                                       anic_root_motion* out) {
  if (!context || !is_sized(out) || (when != ANIC_WHEN_CURRENT && when != ANIC_WHEN_PREVIOUS))
    return ANIC_E_ARGUMENT;
  if (!context->chosen)
    return ANIC_E_STATE;
  const anic_context::State& state = context->states[when];
  give_root(context->asset->clip, state.root, state.holds, out);
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
  const uint32_t elements = found->header.elements(clip.limits().meshes[mesh]);
  if (first > elements || count > elements - first)
    return ANIC_E_ARGUMENT;
  const uint32_t components = found->header.components();
  anic_value_output wanted;
  if (!out || !take(out, &wanted))
    return ANIC_E_ARGUMENT;
  ValueOutput output;
  if (Status status = ValueOutput::make(wanted, components, count, &output); status != Status::kOk)
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
  if (frame_count > 0 && !is_sized(outputs))
    return ANIC_E_ARGUMENT;
  const size_t stride = frame_count > 0 ? host_size(outputs) : 0;
  for (uint32_t f = 0; f < frame_count; ++f) {
    const auto* output = reinterpret_cast<const anic_output*>(
        reinterpret_cast<const unsigned char*>(outputs) + stride * f);
    if (host_size(output) != stride)
      return ANIC_E_ARGUMENT;
    if (frames[f] >= asset->clip.frame_count())
      return ANIC_E_FRAME_RANGE;
    const Segment* segment = asset->clip.segment_at(mesh, frames[f]);
    if (!segment || !asset->has_clip(asset->clip.clip_at(frames[f])))
      return ANIC_E_ABSENT;
    if (!segment->msgi.empty())
      return ANIC_E_STATE;
    states[f] = asset->clip.state_of(*segment, frames[f] - segment->first_frame);
    states[f].components = played_components(*segment, asset->quality);
    if (Status status = check_output(output, count, &to[f]); status != Status::kOk)
      return c_status(status);
  }
  if (count > 0)
    play(states, frame_count, first, count, to);
  return ANIC_OK;
}
