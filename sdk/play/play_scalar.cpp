// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Playing in plain loops: what the other kernels are tested against.
#include "sdk/base/half_float.h"
#include "sdk/play/play_loop.h"

namespace anicodec {
namespace {

/// sum[c][i] += weight * q[c][i]: components of vectors.
template <class Int>
void add_vectors(const Int* q, const float* weights, uint32_t count, Block& sum) {
  for (uint32_t j = 0; j < count; ++j, q += 3 * kBlock) {
    for (uint32_t c = 0; c < 3; ++c) {
      for (uint32_t i = 0; i < kBlock; ++i)
        sum[c][i] += weights[j] * static_cast<float>(q[c * kBlock + i]);
    }
  }
}

/// sum[c][i] += weight[c] * q[i]: components of scalars.
template <class Int>
void add_scalars(const Int* q, const float* weights, uint32_t count, Block& sum) {
  for (uint32_t j = 0; j < count; ++j, q += kBlock, weights += 3) {
    for (uint32_t c = 0; c < 3; ++c) {
      for (uint32_t i = 0; i < kBlock; ++i)
        sum[c][i] += weights[c] * static_cast<float>(q[i]);
    }
  }
}

/// The map of each point of `in`, which is not `out`.
void transform(const float* map, const float (*in)[kBlock], Block& out) {
  for (uint32_t r = 0; r < 3; ++r) {
    const float* m = map + size_t{4} * r;
    for (uint32_t i = 0; i < kBlock; ++i)
      out[r][i] = m[3] + m[0] * in[0][i] + m[1] * in[1][i] + m[2] * in[2][i];
  }
}

template <uint32_t Channels>
void play_block(const PlayJob& job, const PlayJob::Frame& frame, uint32_t block, Block& sum) {
  if (job.pose) {
    Block pose;
    ANICODEC_COPY(pose, job.pose + size_t{block} * 3 * kBlock, sizeof pose);
    transform(frame.pose_map, pose, sum);
  } else {
    ANICODEC_CLEAR(sum, sizeof sum);
  }
  const size_t scalars = size_t{block} * Channels * kBlock;
  const int32_t* wide = job.wide + scalars * job.wide_row;
  const int16_t* narrow = job.narrow + scalars * job.narrow_row;
  if (Channels == 3) {
    add_vectors(wide, frame.weights, job.wide_components, sum);
    add_vectors(narrow, frame.weights + job.wide_components, job.narrow_components, sum);
  } else {
    add_scalars(wide, frame.weights, job.wide_components, sum);
    add_scalars(narrow, frame.weights + size_t{3} * job.wide_components, job.narrow_components,
                sum);
  }
  for (uint32_t c = 0; !job.pose && c < 3; ++c) {  // last, as it may be large
    for (uint32_t i = 0; i < kBlock; ++i)
      sum[c][i] += job.origin[c];
  }
}

uint16_t normalised(float x, float low, float high, float bias, int32_t integer_bias) {
  x = x > low ? x : low;
  x = x < high ? x : high;
  return static_cast<uint16_t>(static_cast<int32_t>(x + bias) - integer_bias);
}

uint16_t element(VertexFormat format, float x) {
  switch (format) {
    case VertexFormat::kUnorm16x3:
    case VertexFormat::kUnorm16x4:
      return normalised(x, 0, 65535, 0.5F, 0);
    case VertexFormat::kSnorm16x3:
    case VertexFormat::kSnorm16x4:
      return normalised(x, -32767, 32767, 32768.5F, 32768);
    default:
      return static_cast<uint16_t>(half_bits<float, int32_t>(x));
  }
}

struct ScalarKernel {
  static constexpr uint32_t blocks_together(uint32_t, uint32_t) { return 1; }

  template <uint32_t F, uint32_t Channels, uint32_t>
  static void sums(const PlayJob& job, uint32_t block, uint32_t, uint32_t, Block* sums,
                   unsigned char* const* direct) {
    for (uint32_t f = 0; f < F; ++f) {
      play_block<Channels>(job, job.frame[f], block, sums[f]);
      for (uint32_t i = 0; direct && i < kBlock; ++i) {
        const float point[3] = {sums[f][0][i], sums[f][1][i], sums[f][2][i]};
        ANICODEC_COPY(direct[f] + size_t{12} * i, point, sizeof point);
      }
    }
  }

  static void move(const float* motion, Block& sum) {
    Block still;
    ANICODEC_COPY(still, sum, sizeof still);
    transform(motion, still, sum);
  }

  static void write(const PlayJob::Frame& frame, const Block& sum, uint32_t begin, uint32_t end,
                    unsigned char* to) {
    write_scalar(frame, sum, begin, end, to);
  }
};

}  // namespace

void write_scalar(const PlayJob::Frame& frame, const float (&sum)[3][kBlock], uint32_t begin,
                  uint32_t end, unsigned char* to) {
  const bool wide = frame.format <= VertexFormat::kFloat32x4;
  const bool fourth = static_cast<uint32_t>(frame.format) % 2;
  for (uint32_t i = begin; i < end; ++i, to += frame.stride) {
    float point[4] = {sum[0][i], sum[1][i], sum[2][i], 1};
    if (wide) {
      ANICODEC_COPY(to, point, fourth ? 16 : 12);
      continue;
    }
    uint16_t small[4];
    for (uint32_t c = 0; c < 3; ++c)
      small[c] = element(frame.format, (point[c] - frame.scale.offset[c]) * frame.scale.factor[c]);
    small[3] = element(frame.format, frame.scale.one);
    ANICODEC_COPY(to, small, fourth ? 8 : 6);
  }
}

void play_scalar(const PlayJob& job) {
  play_job<ScalarKernel>(job);
}

const PlayKernels kPlayKernelsScalar = {"scalar", false, play_scalar};

}  // namespace anicodec
