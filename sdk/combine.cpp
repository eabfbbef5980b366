// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment.h"

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

ANICODEC_CLONES
void combine_blocks(const Segment& s, uint32_t frame, float* out) {
  uint32_t narrow = s.components - s.wide_components;
  uint32_t channels = s.channels();
  size_t wide_stride = size_t{s.wide_components} * channels * kBlock;
  size_t narrow_stride = size_t{narrow} * channels * kBlock;
  const float* weights = s.weights.data() + size_t{frame} * s.components * s.weight_channels();
  const float* narrow_weights = weights + size_t{s.wide_components} * s.weight_channels();
  for (uint32_t b = 0, blocks = block_count(s.vertices); b < blocks; ++b) {
    float sum[3][kBlock] = {};
    if (!s.pose.empty()) {
      float pose[3][kBlock];
      for (uint32_t i = 0; i < 3 * kBlock; ++i)
        pose[i / kBlock][i % kBlock] = s.pose[size_t{b} * 3 * kBlock + i];
      transform(s.pose_maps[frame], pose, sum);
    }
    const int32_t* wide = s.wide.data() + b * wide_stride;
    const int16_t* small = s.narrow.data() + b * narrow_stride;
    if (channels == 3) {
      add_vectors(wide, weights, s.wide_components, sum);
      add_vectors(small, narrow_weights, narrow, sum);
    } else {
      add_scalars(wide, weights, s.wide_components, sum);
      add_scalars(small, narrow_weights, narrow, sum);
    }
    if (!s.motions.empty()) {
      float still[3][kBlock];
      for (uint32_t c = 0; c < 3; ++c) {
        for (uint32_t i = 0; i < kBlock; ++i)
          still[c][i] = sum[c][i] + static_cast<float>(s.origin[c]);
      }
      transform(s.motions[frame], still, sum);
    } else if (s.pose.empty()) {
      for (uint32_t c = 0; c < 3; ++c) {
        for (uint32_t i = 0; i < kBlock; ++i)
          sum[c][i] += static_cast<float>(s.origin[c]);
      }
    }
    uint32_t first = b * kBlock;
    uint32_t count = s.vertices - first < kBlock ? s.vertices - first : kBlock;
    float* to = out + size_t{3} * first;
    for (uint32_t i = 0; i < count; ++i) {
      for (uint32_t c = 0; c < 3; ++c)
        *to++ = sum[c][i];
    }
  }
}

template <class T>
size_t bytes(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}

}  // namespace

void combine(const Segment& segment, uint32_t frame, float* out) {
  combine_blocks(segment, frame, out);
  if (segment.correction_begin.empty())
    return;
  for (uint32_t i = segment.correction_begin[frame]; i < segment.correction_begin[frame + 1]; ++i) {
    const Segment::Correction& correction = segment.corrections[i];
    for (size_t c = 0; c < 3; ++c)
      out[size_t{3} * correction.vertex + c] += correction.delta[c];
  }
}

size_t Segment::resident_bytes() const {
  return bytes(pose) + bytes(wide) + bytes(narrow) + bytes(weights) + bytes(pose_maps) +
         bytes(motions) + bytes(correction_begin) + bytes(corrections);
}

}  // namespace anicodec
