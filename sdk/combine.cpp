// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/combine.h"

#include <algorithm>

namespace anicodec {
namespace {

// One clone per instruction set, chosen when the library is loaded.
#if defined(__x86_64__) && defined(__linux__)
#define ANICODEC_CLONES __attribute__((target_clones("arch=haswell", "default")))
#else
#define ANICODEC_CLONES
#endif

/// sum[c][i] += weight * q[c][i], c < 3: a component of vectors.
template <class Int>
inline void add_vectors(const Int* q, const float* weights, uint32_t count, float (*sum)[kBlock]) {
  for (uint32_t j = 0; j < count; ++j, q += 3 * kBlock) {
    float w = weights[j];
    for (uint32_t c = 0; c < 3; ++c) {
      for (uint32_t i = 0; i < kBlock; ++i)
        sum[c][i] += w * static_cast<float>(q[c * kBlock + i]);
    }
  }
}

/// sum[c][i] += weight[c] * q[i]: a component of scalars.
template <class Int>
inline void add_scalars(const Int* q, const float* weights, uint32_t count, float (*sum)[kBlock]) {
  for (uint32_t j = 0; j < count; ++j, q += kBlock) {
    float x = weights[3 * j], y = weights[3 * j + 1], z = weights[3 * j + 2];
    for (uint32_t i = 0; i < kBlock; ++i) {
      auto value = static_cast<float>(q[i]);
      sum[0][i] += x * value;
      sum[1][i] += y * value;
      sum[2][i] += z * value;
    }
  }
}

inline void transform(const Affine& map, const float (*in)[kBlock], float (*out)[kBlock]) {
  for (uint32_t r = 0; r < 3; ++r) {
    const float* m = map.m + 4 * r;
    for (uint32_t i = 0; i < kBlock; ++i)
      out[r][i] = m[3] + m[0] * in[0][i] + m[1] * in[1][i] + m[2] * in[2][i];
  }
}

/// One block of the segment: sum[c][i] is coordinate c of its vertex i, without corrections.
inline void combine_block(const FrameState& state, uint32_t block, float (*sum)[kBlock]) {
  const Segment& s = *state.segment;
  uint32_t narrow = s.components - s.wide_components;
  uint32_t channels = s.channels();
  const float* weights = state.weights;
  const float* narrow_weights = weights + size_t{s.wide_components} * s.weight_channels();
  if (s.pose.empty()) {
    std::fill_n(sum[0], 3 * kBlock, 0.F);
  } else {
    float pose[3][kBlock];
    for (uint32_t i = 0; i < 3 * kBlock; ++i)
      pose[i / kBlock][i % kBlock] = s.pose[size_t{block} * 3 * kBlock + i];
    transform(state.pose_map, pose, sum);
  }
  const int32_t* wide = s.wide.data() + size_t{block} * s.wide_components * channels * kBlock;
  const int16_t* small = s.narrow.data() + size_t{block} * narrow * channels * kBlock;
  if (channels == 3) {
    add_vectors(wide, weights, s.wide_components, sum);
    add_vectors(small, narrow_weights, narrow, sum);
  } else {
    add_scalars(wide, weights, s.wide_components, sum);
    add_scalars(small, narrow_weights, narrow, sum);
  }
  if (s.pose.empty()) {  // last, as it may be large
    for (uint32_t c = 0; c < 3; ++c) {
      for (uint32_t i = 0; i < kBlock; ++i)
        sum[c][i] += static_cast<float>(s.origin[c]);
    }
  }
  if (!s.motions.empty()) {
    float still[3][kBlock];
    std::copy_n(sum[0], 3 * kBlock, still[0]);
    transform(state.motion, still, sum);
  }
}

ANICODEC_CLONES
void combine_range(const FrameState& state, uint32_t first, uint32_t count, float* out) {
  const Segment::Correction* correction = state.corrections;
  const Segment::Correction* corrections_end = correction + state.correction_count;
  correction = std::partition_point(correction, corrections_end,
                                    [&](const auto& c) { return c.vertex < first; });
  for (uint32_t end = first + count; first < end;) {
    uint32_t block = first / kBlock;
    float sum[3][kBlock];
    combine_block(state, block, sum);
    uint32_t stop = std::min(end, (block + 1) * kBlock);
    for (; correction != corrections_end && correction->vertex < stop; ++correction) {
      for (uint32_t c = 0; c < 3; ++c)
        sum[c][correction->vertex % kBlock] += correction->delta[c];
    }
    for (; first < stop; ++first) {
      for (uint32_t c = 0; c < 3; ++c)
        *out++ = sum[c][first % kBlock];
    }
  }
}

}  // namespace

FrameState frame_state(const Segment& segment, uint32_t frame) {
  FrameState state;
  state.segment = &segment;
  state.weights =
      segment.weights.data() + size_t{frame} * segment.components * segment.weight_channels();
  if (!segment.pose_maps.empty())
    state.pose_map = segment.pose_maps[frame];
  if (!segment.motions.empty())
    state.motion = segment.motions[frame];
  if (!segment.correction_begin.empty()) {
    uint32_t begin = segment.correction_begin[frame];
    state.corrections = segment.corrections.data() + begin;
    state.correction_count = segment.correction_begin[frame + 1] - begin;
  }
  return state;
}

void combine(const FrameState& state, uint32_t first, uint32_t count, float* out) {
  combine_range(state, first, count, out);
}

}  // namespace anicodec
