// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Playing kernels for W = 4, 8 or 16 vertices at once. A lane is a vertex; every sum begins with
// the base and runs over the components in ascending order, so that neither the number of lanes nor
// the frames made together nor the range asked for changes a bit. The including file is compiled
// once per instruction set: see lanes.h.
#ifndef ANICODEC_SDK_COMBINE_LANES_H_
#define ANICODEC_SDK_COMBINE_LANES_H_

#include "sdk/combine_loop.h"
#include "sdk/lanes.h"
#include "sdk/output_lanes.h"

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace anicodec {
namespace {

#if defined(__FMA__) || defined(__aarch64__)
constexpr bool kFused = true;
#else
constexpr bool kFused = false;
#endif

template <size_t W>
struct LaneKernel {
  using Float = typename LaneTypes<W>::Float;

  static ANICODEC_INLINE Float load(const float* from) {
    Float v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  }

  static ANICODEC_INLINE void store(float* to, Float v) { __builtin_memcpy(to, &v, sizeof v); }

  static ANICODEC_INLINE Float splat(float x) { return Float{} + x; }

  /// a b + c, rounded once where the machine can.
  static ANICODEC_INLINE Float multiply_add(Float a, Float b, Float c) {
#if defined(__FMA__)
    if constexpr (W == 4)
      return reinterpret_cast<Float>(_mm_fmadd_ps(a, b, c));
    else if constexpr (W == 8)
      return reinterpret_cast<Float>(_mm256_fmadd_ps(a, b, c));
#if defined(__AVX512F__)
    else if constexpr (W == 16)
      return reinterpret_cast<Float>(_mm512_fmadd_ps(a, b, c));
#endif
#elif defined(__aarch64__)
    static_assert(W == 4, "NEON has four lanes");
    return vfmaq_f32(c, a, b);
#else
    return a * b + c;
#endif
  }

  template <class Int>
  static ANICODEC_INLINE Float widen(const Int* q) {
    typedef Int Vector __attribute__((vector_size(sizeof(Int) * W)));
    Vector v;
    __builtin_memcpy(&v, q, sizeof v);
#if defined(__SSE2__) && !defined(__SSE4_1__)
    if constexpr (W == 4 && sizeof(Int) == 2) {
      const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(q));
      return _mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(low, low), 16));
    }
#endif
    return __builtin_convertvector(v, Float);
  }

  /// out = map (in), a 3 x 4 matrix.
  static ANICODEC_INLINE void transform(const float* map, const Float* in, Float* out) {
    ANICODEC_UNROLL for (size_t r = 0; r < 3; ++r) {
      const float* m = map + 4 * r;
      Float s = splat(m[3]);
      ANICODEC_UNROLL for (size_t d = 0; d < 3; ++d) s = multiply_add(in[d], splat(m[d]), s);
      out[r] = s;
    }
  }

  /// Adds `count` components to F frames, N vectors of lanes at a time.
  template <uint32_t F, size_t N, uint32_t Channels, class Int>
  static ANICODEC_INLINE void add(const Int* q, uint32_t count, const float* const* weights,
                                  Block* sums) {
    constexpr size_t kWeights = Channels == 1 ? 3 : 1;
    for (size_t h = 0; h < kBlock; h += N * W) {
      Float s[F][3][N];
      ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f)
          ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c)
              ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) s[f][c][n] =
                  load(sums[f][c] + h + n * W);
      const float* w[F];
      ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f) w[f] = weights[f];
      const Int* p = q + h;
      for (uint32_t j = 0; j < count; ++j, p += Channels * kBlock) {
        if constexpr (Channels == 1) {
          Float x[N];
          ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) x[n] = widen(p + n * W);
          ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f)
              ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) {
            const Float u = splat(w[f][c]);
            ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) s[f][c][n] =
                multiply_add(x[n], u, s[f][c][n]);
          }
        } else {
          ANICODEC_UNROLL for (size_t n = 0; n < N; ++n)
              ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) {
            const Float x = widen(p + c * kBlock + n * W);
            ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f) s[f][c][n] =
                multiply_add(x, splat(w[f][0]), s[f][c][n]);
          }
        }
        ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f) w[f] += kWeights;
      }
      ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f)
          ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c)
              ANICODEC_UNROLL for (size_t n = 0; n < N; ++n)
                  store(sums[f][c] + h + n * W, s[f][c][n]);
    }
  }

  /// As many sums in registers as there are registers for them.
  template <uint32_t F, uint32_t Channels, class Int>
  static void add_all(const Int* q, uint32_t count, const float* const* weights, Block* sums) {
    constexpr size_t kVectors = F * 6 * W <= 12 * 16 && kBlock % (2 * W) == 0 ? 2 : 1;
    if (count > 0)
      add<F, kVectors, Channels>(q, count, weights, sums);
  }

  template <uint32_t F>
  static ANICODEC_INLINE void sums(const CombineJob& job, uint32_t block, Block* sums) {
    const float* weights[F];
    const float* narrow_weights[F];
    for (uint32_t f = 0; f < F; ++f) {
      weights[f] = job.frame[f].weights;
      narrow_weights[f] = weights[f] + size_t{job.wide_components} * (job.channels == 1 ? 3 : 1);
    }
    if (job.pose) {
      const float* pose = job.pose + size_t{block} * 3 * kBlock;
      for (size_t h = 0; h < kBlock; h += W) {
        Float in[3], out[3];
        ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) in[c] = load(pose + c * kBlock + h);
        for (uint32_t f = 0; f < F; ++f) {
          transform(job.frame[f].pose_map, in, out);
          ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) store(sums[f][c] + h, out[c]);
        }
      }
    } else {
      __builtin_memset(sums, 0, F * sizeof(Block));
    }
    const size_t scalars = size_t{block} * job.channels * kBlock;
    const int32_t* wide = job.wide + scalars * job.wide_components;
    const int16_t* narrow = job.narrow + scalars * job.narrow_components;
    if (job.channels == 3) {
      add_all<F, 3>(wide, job.wide_components, weights, sums);
      add_all<F, 3>(narrow, job.narrow_components, narrow_weights, sums);
    } else {
      add_all<F, 1>(wide, job.wide_components, weights, sums);
      add_all<F, 1>(narrow, job.narrow_components, narrow_weights, sums);
    }
    for (uint32_t f = 0; f < F; ++f) {
      if (!job.pose)  // last, as it may be large
        for (size_t c = 0; c < 3; ++c)
          for (size_t h = 0; h < kBlock; h += W)
            store(sums[f][c] + h, load(sums[f][c] + h) + job.origin[c]);
      if (job.frame[f].motion)
        for (size_t h = 0; h < kBlock; h += W) {
          Float in[3], out[3];
          for (size_t c = 0; c < 3; ++c)
            in[c] = load(sums[f][c] + h);
          transform(job.frame[f].motion, in, out);
          for (size_t c = 0; c < 3; ++c)
            store(sums[f][c] + h, out[c]);
        }
    }
  }

  static void write(const CombineJob::Frame& frame, const Block& sums, uint32_t begin, uint32_t end,
                    unsigned char* to) {
    OutputLanes<(W < 8 ? W : 8)>::write(frame, sums, begin, end, to);
  }
};

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_COMBINE_LANES_H_
