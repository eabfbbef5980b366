// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Playing kernels for W = 4, 8 or 16 vertices at once. A lane is a vertex; every sum begins with
// the base and runs over the components in ascending order, so that neither the number of lanes nor
// the frames made together nor the range asked for changes a bit. The including file is compiled
// once per instruction set: see lanes.h.
#ifndef ANICODEC_SDK_PLAY_PLAY_LANES_H_
#define ANICODEC_SDK_PLAY_PLAY_LANES_H_

#include "sdk/base/lanes.h"
#include "sdk/play/output_lanes.h"
#include "sdk/play/play_loop.h"

#if defined(__SSE2__)
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

// Sums that are kept in registers, which are 32 or 16: the others are for weights and coefficients.
#if defined(__aarch64__) || defined(__AVX512VL__)
constexpr size_t kSums = 24;
#else
constexpr size_t kSums = 12;
#endif

template <size_t W>
struct LaneKernel {
  using Float = typename LaneTypes<W>::Float;

  /// Bytes between what is read and what is asked for: coefficients are read in order, through many
  /// pages, faster than the machine foresees by itself, and the faster the more lanes there are.
  static constexpr size_t kAhead = W == 16 ? 8192 : 4096;

  static ANICODEC_INLINE Float load(const float* from) {
    Float v;
    ANICODEC_COPY(&v, from, sizeof v);
    return v;
  }

  static ANICODEC_INLINE void store(float* to, Float v) { ANICODEC_COPY(to, &v, sizeof v); }

  static ANICODEC_INLINE Float splat(float x) {
    return x - Float{};  // not +, which -0 would not survive
  }

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
#if defined(__AVX512F__)
    if constexpr (W == 16 && sizeof(Int) == 2) {
      const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(q));
      const auto all = static_cast<__mmask16>(-1);  // GCC 12 warns where there is no mask
      return ANICODEC_CONVERT(
          reinterpret_cast<typename LaneTypes<W>::Int>(_mm512_maskz_cvtepi16_epi32(all, v)), Float);
    }
#endif
#if defined(__AVX2__)
    if constexpr (W == 8 && sizeof(Int) == 2) {
      const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(q));
      return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(v));
    }
#elif defined(__SSE2__)
    if constexpr (W == 4 && sizeof(Int) == 2) {
      const __m128i v = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(q));
      return _mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(v, v), 16));
    }
#elif defined(__wasm_simd128__)
    if constexpr (W == 4 && sizeof(Int) == 2)
      return widened_four(q);
#endif
    typedef Int Vector ANICODEC_VECTOR(sizeof(Int) * W);
    Vector v;
    ANICODEC_COPY(&v, q, sizeof v);
    return ANICODEC_CONVERT(v, Float);
  }

  /// Asks for what lies so many bytes from q, be it beyond the end.
  static ANICODEC_INLINE void fetch(const void* q, size_t bytes) {
    ANICODEC_PREFETCH(reinterpret_cast<const void*>(reinterpret_cast<uintptr_t>(q) + bytes));
  }

  /// out = map (in), a 3 x 4 matrix.
  template <size_t N>
  static ANICODEC_INLINE void transform(const float* map, const Float (&in)[3][N],
                                        Float (&out)[3][N]) {
    ANICODEC_UNROLL for (size_t r = 0; r < 3; ++r) {
      const float* m = map + 4 * r;
      ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) out[r][n] = splat(m[3]);
      ANICODEC_UNROLL for (size_t d = 0; d < 3; ++d) {
        const Float x = splat(m[d]);
        ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) out[r][n] =
            multiply_add(in[d][n], x, out[r][n]);
      }
    }
  }

  /// Vectors of vertices that so many frames are made of at a time: two where there are registers
  /// for the sums, which hides how long a multiply-add takes. Components of vectors are as fast as
  /// memory without, and slower where two blocks of them are read side by side.
  static constexpr size_t vectors(uint32_t frames, uint32_t channels) {
    return frames * 6 <= kSums && (2 * W <= kBlock || channels == 1) ? 2 : 1;
  }

  static constexpr uint32_t blocks_together(uint32_t frames, uint32_t channels) {
    const size_t lanes = vectors(frames, channels) * W;
    return lanes > kBlock ? static_cast<uint32_t>(lanes / kBlock) : 1;
  }

  /// The place of vector n, in an array that has a block every `block_elements` elements.
  static constexpr size_t place(size_t n, size_t block_elements) {
    return n * W / kBlock * block_elements + n * W % kBlock;
  }

  /// s += the first `count` of the `row` components of a block from its vertex h on; `block` may be
  /// null when there are none.
  template <uint32_t Channels, uint32_t F, size_t N, class Int>
  static ANICODEC_INLINE void add(const Int* block, size_t h, uint32_t count, uint32_t row,
                                  const float* const* weights, Float (&s)[F][3][N]) {
    constexpr size_t kWeights = Channels == 1 ? 3 : 1;
    if (count == 0)
      return;
    const Int* q = block + h;
    const size_t block_elements = size_t{row} * Channels * kBlock;
    constexpr size_t kBlocks = N * W > kBlock ? N * W / kBlock : 1;
    size_t ahead = kAhead;
    if constexpr (kBlocks > 1) {  // the same place in blocks to come, as those between are read now
      const size_t bytes = kBlocks * block_elements * sizeof(Int);
      ahead = (kAhead / bytes + 1) * bytes;
    }
    const float* w[F];
    ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f) w[f] = weights[f];
    for (uint32_t j = 0; j < count; ++j) {
      Float x[Channels][N];
      ANICODEC_UNROLL for (size_t c = 0; c < Channels; ++c)
          ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) x[c][n] =
              widen(q + c * kBlock + place(n, block_elements));
      ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f)
          ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) {
        const Float u = splat(w[f][c % kWeights]);
        ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) s[f][c][n] =
            multiply_add(x[c % Channels][n], u, s[f][c][n]);
      }
      ANICODEC_UNROLL for (size_t b = 0; b < kBlocks; ++b) {
        fetch(q + b * block_elements, ahead);
        if constexpr (Channels > 1 && (N > 1 || W == kBlock))  // more than a line of the cache
          fetch(q + b * block_elements, ahead + Channels * kBlock);
      }
      q += Channels * kBlock;
      ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f) w[f] += kWeights;
    }
  }

  /// The frames first .. first + F - 1 of B blocks, of AllF frames.
  template <uint32_t F, uint32_t AllF, uint32_t Channels, uint32_t B>
  static ANICODEC_INLINE void some_sums(const PlayJob& job, uint32_t first, uint32_t block,
                                        uint32_t begin, uint32_t end, Block* sums,
                                        unsigned char* const* direct) {
    constexpr size_t kMost = B * kBlock / W;
    constexpr size_t N = vectors(F, Channels) < kMost ? vectors(F, Channels) : kMost;
    const PlayJob::Frame* frame = job.frame + first;
    const float* weights[F];
    const float* narrow_weights[F];
    for (uint32_t f = 0; f < F; ++f) {
      weights[f] = frame[f].weights;
      narrow_weights[f] = weights[f] + size_t{job.wide_components} * (Channels == 1 ? 3 : 1);
    }
    const size_t scalars = size_t{block} * Channels * kBlock;
    const int32_t* wide = job.wide + scalars * job.wide_row;
    const int16_t* narrow = job.narrow + scalars * job.narrow_row;
    const size_t stop = end < kBlock ? end : kBlock;
    for (size_t h = begin / (N * W) * (N * W); h < stop; h += N * W) {
      Float s[F][3][N];
      if (job.pose) {
        Float in[3][N];
        ANICODEC_UNROLL for (size_t d = 0; d < 3; ++d)
            ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) in[d][n] =
                load(job.pose + (size_t{block} * 3 + d) * kBlock + h + place(n, 3 * kBlock));
        ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f) transform<N>(frame[f].pose_map, in, s[f]);
      } else {
        ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f)
            ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c)
                ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) s[f][c][n] = Float{};
      }
      add<Channels>(wide, h, job.wide_components, job.wide_row, weights, s);
      add<Channels>(narrow, h, job.narrow_components, job.narrow_row, narrow_weights, s);
      if (!job.pose) {  // last, as it may be large
        ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f)
            ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c)
                ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) s[f][c][n] += job.origin[c];
      }
      ANICODEC_UNROLL for (uint32_t f = 0; f < F; ++f)
          ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) {
        if (direct) {
          OutputLanes<W>::interleave3(s[f][0][n], s[f][1][n], s[f][2][n],
                                      direct[f] + 12 * (h + n * W));
        } else {
          ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c)
              store(sums[n * W / kBlock * AllF + f][c] + h + n * W % kBlock, s[f][c][n]);
        }
      }
    }
  }

  template <uint32_t F, uint32_t Channels, uint32_t B>
  static ANICODEC_INLINE void sums(const PlayJob& job, uint32_t block, uint32_t begin, uint32_t end,
                                   Block* sums, unsigned char* const* direct) {
    // Two frames of scalars and all 16 vertices use as many registers as four frames of half of
    // them, and load fewer weights.
    constexpr uint32_t kFirst = Channels == 1 && F > 2 && kSums < 24 && 2 * W <= kBlock ? 2 : F;
    some_sums<kFirst, F, Channels, B>(job, 0, block, begin, end, sums, direct);
    if constexpr (kFirst < F)
      some_sums<F - kFirst, F, Channels, B>(job, kFirst, block, begin, end, sums + kFirst,
                                            direct ? direct + kFirst : nullptr);
  }

  static ANICODEC_INLINE void move(const float* motion, Block& sums) {
    for (size_t h = 0; h < kBlock; h += W) {
      Float in[3][1], out[3][1];
      ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) in[c][0] = load(sums[c] + h);
      transform<1>(motion, in, out);
      ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) store(sums[c] + h, out[c][0]);
    }
  }

  static void write(const PlayJob::Frame& frame, const Block& sums, uint32_t begin, uint32_t end,
                    unsigned char* to) {
    OutputLanes<W>::write(frame, sums, begin, end, to);
  }
};

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_PLAY_LANES_H_
