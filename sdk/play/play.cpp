// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/play.h"

#include "format/compiler.h"
#include "sdk/play/play_job.h"

#include <algorithm>

#if defined(ANICODEC_PLAY_AVX2)
#include "sdk/base/cpu_features.h"
#endif

namespace anicodec {
namespace {

OutputScale output_scale(const VertexOutput& output) {
  OutputScale scale = {};
  switch (output.format) {
    case VertexFormat::kUnorm16x3:
    case VertexFormat::kUnorm16x4:
      scale.one = 65535;
      break;
    case VertexFormat::kSnorm16x3:
    case VertexFormat::kSnorm16x4:
      scale.one = 32767;
      break;
    default:
      scale.one = 1;
  }
  for (size_t c = 0; c < 3; ++c) {
    scale.offset[c] = output.offset[c];
    scale.factor[c] = scale.one / output.scale[c];
  }
  return scale;
}

void set_segment(const Segment& segment, uint32_t components, PlayJob* job) {
  job->channels = segment.channels();
  job->wide_row = segment.wide_components;
  job->narrow_row = segment.components - segment.wide_components;
  job->wide_components = std::min(components, segment.wide_components);
  job->narrow_components = components - job->wide_components;
  job->wide = segment.wide.data();
  job->narrow = segment.narrow.data();
  job->pose = segment.pose.empty() ? nullptr : segment.pose.data();
  for (size_t c = 0; c < 3; ++c)
    job->origin[c] = static_cast<float>(segment.origin[c]);
}

void set_output(const VertexOutput& output, PlayJob::Frame* frame) {
  frame->out = static_cast<unsigned char*>(output.data);
  frame->stride = output.stride;
  frame->format = output.format;
  frame->scale = output_scale(output);
}

void set_state(const FrameState& state, uint32_t first, uint32_t region, PlayJob::Frame* frame) {
  frame->weights = state.weights + region * region_weights(*state.segment);
  frame->pose_map = state.pose_maps ? state.pose_maps + size_t{12} * region : nullptr;
  frame->motion = state.moves ? state.motion.m : nullptr;
  frame->corrections_end = state.corrections + state.correction_count;
  frame->correction = std::partition_point(state.corrections, frame->corrections_end,
                                           [&](const auto& c) { return c.vertex < first; });
}

/// The first vertex behind `first` that is in another region; `end` if there is none before.
uint32_t end_of_run(const uint8_t* regions, uint32_t first, uint32_t end) {
  const uint64_t same = regions[first] * uint64_t{0x0101010101010101};
  uint32_t next = first + 1;
  for (uint64_t eight = same; end - next >= 8; next += 8) {  // as most are in long runs
    ANICODEC_COPY(&eight, regions + next, sizeof eight);
    if (eight != same)
      break;
  }
  while (next < end && regions[next] == regions[first])
    ++next;
  return next;
}

/// Positions made with one set of kernels: of a few frames of a segment, for a range of vertices.
class RegionPlayer {
 public:
  /// The states are of one segment and play as many components; kMaxPlayedFrames at most.
  RegionPlayer(const PlayKernels& kernels, const FrameState* states, uint32_t frames,
               const VertexOutput* outputs)
      : kernels_(kernels), segment_(*states->segment), states_(states) {
    set_segment(segment_, states->components, &job_);
    job_.frames = frames;
    for (uint32_t f = 0; f < frames; ++f)
      set_output(outputs[f], &job_.frame[f]);
  }

  /// Vertices of one region go to the outputs.
  void play_region(uint32_t region, uint32_t first, uint32_t count) {
    job_.first = first;
    job_.end = first + count;
    for (uint32_t f = 0; f < job_.frames; ++f)
      set_state(states_[f], first, region, &job_.frame[f]);
    kernels_.play(job_);
  }

  /// Vertices that follow one another in one region are played as a whole.
  void play(uint32_t begin, uint32_t count) {
    const uint8_t* regions = segment_.vertex_region.data();
    for (uint32_t first = begin, end = begin + count; first < end;) {
      const uint32_t next = end_of_run(regions, first, end);
      play_region(regions[first], first, next - first);
      // Only to a vertex that is there: strides are as large as hosts want.
      for (uint32_t f = 0; f < job_.frames && next < end; ++f)
        job_.frame[f].out += job_.frame[f].stride * (next - first);
      first = next;
    }
  }

 private:
  const PlayKernels& kernels_;
  const Segment& segment_;
  const FrameState* states_;
  PlayJob job_;
};

/// Vertices of a shape that are moved at a time.
constexpr uint32_t kPlayRange = 16 * kBlock;

/// Moves and corrects the vertices of a shape, and stores them.
void combine_shape(const FrameState& state, uint32_t first, uint32_t count, VertexOutput output) {
  const Segment& segment = *state.segment;
  const Affine identity;
  const float* m = state.moves ? state.motion.m : identity.m;
  const Segment::Correction* end = state.corrections + state.correction_count;
  const Segment::Correction* correction =
      std::partition_point(state.corrections, end, [&](const auto& c) { return c.vertex < first; });
  float blocks[3 * kPlayRange];
  for (const uint32_t stop = first + count; first < stop;) {
    const uint32_t base = first / kPlayRange * kPlayRange, last = std::min(stop, base + kPlayRange);
    for (uint32_t v = first; v < last; ++v) {
      const float* p =
          state.shape + size_t{3} * (segment.vertex_coded.empty() ? v : segment.vertex_coded[v]);
      const bool corrected = correction != end && correction->vertex == v;
      for (uint32_t c = 0; c < 3; ++c) {
        const float* row = m + size_t{4} * c;
        float x = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        if (corrected)
          x += correction->delta[c];
        blocks[((v - base) / kBlock * 3 + c) * kBlock + (v - base) % kBlock] = x;
      }
      correction += corrected;
    }
    store_points(blocks, first - base, last - first, output);
    output.data = static_cast<unsigned char*>(output.data) + output.stride * (last - first);
    first = last;
  }
}

/// Stores exact positions: no arithmetic on numbers of 32 bits.
void store_exact(const FrameState& state, uint32_t first, uint32_t count,
                 const VertexOutput& output) {
  const Vector<uint32_t>& coded = state.segment->vertex_coded;
  PlayJob::Frame frame;
  set_output(output, &frame);
  for (const uint32_t stop = first + count; first < stop;) {
    const uint32_t base = first / kBlock * kBlock, last = std::min(stop, base + kBlock);
    float block[3][kBlock] = {};
    for (uint32_t v = first; v < last; ++v) {
      for (uint32_t c = 0; c < 3; ++c)
        block[c][v - base] = state.exact[size_t{3} * (coded.empty() ? v : coded[v]) + c];
    }
    write_scalar(frame, block, first - base, last - base, frame.out);
    frame.out += frame.stride * (last - first);
    first = last;
  }
}

/// The next multiple of 8.
double* aligned(float* p) {
  return reinterpret_cast<double*>(p + reinterpret_cast<uintptr_t>(p) % 8 / sizeof(float));
}

}  // namespace

uint32_t played_components(const Segment& segment, double quality) {
  return segment.kind == BasisKind::kKeyframes ? segment.components
                                               : wanted_components(quality, segment.components);
}

size_t shape_size(const Segment& segment) {
  return segment.msgi.empty() ? 0 : size_t{3} * segment.msgi[0].vertex_count();
}

size_t shape_scratch_size(const Segment& segment) {
  if (segment.msgi.empty())
    return 0;
  return static_cast<size_t>(
             shape_scratch_bytes(segment.components, segment.msgi[0].scratch_bytes())) /
         sizeof(float);
}

uint64_t shape_scratch_bytes(uint64_t components, uint64_t msgi_frame_bytes) {
  // Weights in double, and room to align them.
  return (msgi_frame_bytes + 7) / 8 * 8 + sizeof(double) * (components + 1);
}

void make_shape(FrameState* state, float* shape, float* scratch) {
  const Segment& segment = *state->segment;
  if (segment.msgi.empty())
    return;
  double* weights = aligned(scratch);
  weights[0] = 1;
  for (uint32_t j = 1; j < segment.components; ++j) {
    weights[j] = double{state->weights[j]} / segment.weight_scale;
    weights[0] -= weights[j];
  }
  const Status status =
      segment.msgi[0].evaluate(weights, nullptr, weights + segment.components, shape);
  // Weights that no encoder writes.
  if (status != Status::kOk)
    std::fill_n(shape, shape_size(segment), 0.0F);
  state->shape = shape;
}

size_t region_weights(const Segment& segment) {
  return size_t{segment.components} * segment.weight_channels();
}

FrameState frame_state(const Segment& segment, uint32_t frame) {
  FrameState state;
  state.segment = &segment;
  state.components = segment.components;
  state.weights =
      segment.weights.data() + size_t{frame} * segment.regions * region_weights(segment);
  if (!segment.pose_maps.empty())
    state.pose_maps = segment.pose_maps[size_t{frame} * segment.regions].m;
  state.moves = !segment.motions.empty();
  if (state.moves)
    state.motion = segment.motions[frame];
  if (!segment.exact.empty())
    state.exact = segment.exact.data() + segment.exact.size() / segment.frames * frame;
  if (!segment.correction_begin.empty()) {
    uint32_t begin = segment.correction_begin[frame];
    state.corrections = segment.corrections.data() + begin;
    state.correction_count = segment.correction_begin[frame + 1] - begin;
  }
  return state;
}

size_t all_play_kernels(const PlayKernels* (&out)[kMaxPlayKernels]) {
  size_t count = 0;
  out[count++] = &kPlayKernelsScalar;
  out[count++] = &kPlayKernelsPortable;
#if defined(ANICODEC_PLAY_AVX2)
  const CpuFeatures& cpu = cpu_features();
  if (cpu.avx2 && cpu.fma && cpu.f16c) {
    out[count++] = &kPlayKernelsAvx2;
    if (cpu.avx512f && cpu.avx512vl) {
      out[count++] = &kPlayKernelsAvx512vl;
      // VBMI2 came with the machines that multiply 512 bits without a much lower clock.
      if (cpu.avx512vbmi2)
        out[count++] = &kPlayKernelsAvx512;
    }
  }
#endif
  return count;
}

const PlayKernels& play_kernels() {
#if !defined(ANICODEC_PLAY_AVX2)
  return kPlayKernelsPortable;  // leaves the reference to the tests
#else
  static const PlayKernels& fastest = []() -> const PlayKernels& {
    const PlayKernels* all[kMaxPlayKernels];
    return *all[all_play_kernels(all) - 1];
  }();
  return fastest;
#endif
}

const char* play_kernels_name() {
  return play_kernels().name;
}

void play_with(const PlayKernels& kernels, const FrameState* states, uint32_t frames,
               uint32_t first, uint32_t count, const VertexOutput* outputs) {
  for (uint32_t f = 0; f < frames;) {
    if (states[f].exact) {
      store_exact(states[f], first, count, outputs[f]);
      ++f;
      continue;
    }
    if (states[f].shape) {
      combine_shape(states[f], first, count, outputs[f]);
      ++f;
      continue;
    }
    uint32_t end = f + 1;
    while (end < frames && end - f < kMaxPlayedFrames && !states[end].exact &&
           states[end].segment == states[f].segment &&
           states[end].components == states[f].components)
      ++end;
    RegionPlayer player(kernels, states + f, end - f, outputs + f);
    if (states[f].segment->vertex_region.empty())
      player.play_region(0, first, count);
    else
      player.play(first, count);
    f = end;
  }
}

void play(const FrameState* states, uint32_t frames, uint32_t first, uint32_t count,
          const VertexOutput* outputs) {
  play_with(play_kernels(), states, frames, first, count, outputs);
}

void play(const FrameState& state, uint32_t first, uint32_t count, float* out) {
  VertexOutput output;
  output.data = out;
  play(&state, 1, first, count, &output);
}

void store_points(const float* blocks, uint32_t first, uint32_t count, const VertexOutput& output) {
  const Affine identity;
  PlayJob job;
  job.pose = blocks;
  job.first = first;
  job.end = first + count;
  job.frames = 1;
  job.frame[0].pose_map = identity.m;
  set_output(output, &job.frame[0]);
  play_kernels().play(job);
}

}  // namespace anicodec
