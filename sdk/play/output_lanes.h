// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Storing positions from W = 4, 8 or 16 vertices at once: coordinates in vectors become points in
// memory, by shuffles within groups of four lanes. The including file is compiled once per
// instruction set: see lanes.h.
#ifndef ANICODEC_SDK_PLAY_OUTPUT_LANES_H_
#define ANICODEC_SDK_PLAY_OUTPUT_LANES_H_

#include "sdk/base/half_float.h"
#include "sdk/base/lanes.h"
#include "sdk/play/play_loop.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace anicodec {
namespace {

template <size_t W>
struct OutputLanes {
  using Float = typename LaneTypes<W>::Float;
  using Int = typename LaneTypes<W>::Int;

  /// The same shuffle of every four lanes; 4 .. 7 are lanes of the second vector.
  template <int I, int J, int K, int L, typename V>
  static ANICODEC_INLINE V shuffle(V a, V b) {
    if constexpr (W == 4) {
      return ANICODEC_SHUFFLE(a, b, I, J, K, L);
    } else {
      constexpr int kSecond = W - 4;
      constexpr int i = I + I / 4 * kSecond, j = J + J / 4 * kSecond, k = K + K / 4 * kSecond,
                    l = L + L / 4 * kSecond;
      if constexpr (W == 8)
        return ANICODEC_SHUFFLE(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4);
      else
        return ANICODEC_SHUFFLE(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4, i + 8, j + 8, k + 8,
                                l + 8, i + 12, j + 12, k + 12, l + 12);
    }
  }

  /// Stores N vectors, the first four lanes of all before the next four.
  template <size_t N, typename V>
  static ANICODEC_INLINE void store(unsigned char* to, const V* v) {
    if constexpr (W == 4) {
      ANICODEC_COPY(to, v, N * sizeof(V));
    } else {
      store_fours<N, 0>(to, v);
      store_fours<N, 1>(to, v);
    }
    if constexpr (W == 16) {
      store_fours<N, 2>(to, v);
      store_fours<N, 3>(to, v);
    }
  }

  template <size_t N, int Four, typename V>
  static ANICODEC_INLINE void store_fours(unsigned char* to, const V* v) {
    constexpr int i = 4 * Four;
    ANICODEC_UNROLL for (size_t n = 0; n < N; ++n) {
      const auto four = ANICODEC_SHUFFLE(v[n], v[n], i, i + 1, i + 2, i + 3);
      ANICODEC_COPY(to + 16 * (N * Four + n), &four, 16);
    }
  }

  static ANICODEC_INLINE Float load(const float* from) {
    Float v;
    ANICODEC_COPY(&v, from, sizeof v);
    return v;
  }

  /// x y z x y z ...
  static ANICODEC_INLINE void interleave3(Float x, Float y, Float z, unsigned char* to) {
    const Float xy = shuffle<0, 2, 4, 6>(x, y), yz = shuffle<1, 3, 5, 7>(y, z),
                zx = shuffle<0, 2, 5, 7>(z, x);
    const Float v[3] = {shuffle<0, 2, 4, 6>(xy, zx), shuffle<0, 2, 5, 7>(yz, xy),
                        shuffle<1, 3, 5, 7>(zx, yz)};
    store<3>(to, v);
  }

  /// x y z 1 x y z 1 ...
  static ANICODEC_INLINE void interleave4(Float x, Float y, Float z, unsigned char* to) {
    const Float one = Float{} + 1.0F;
    const Float xy = shuffle<0, 4, 1, 5>(x, y), xy2 = shuffle<2, 6, 3, 7>(x, y),
                zw = shuffle<0, 4, 1, 5>(z, one), zw2 = shuffle<2, 6, 3, 7>(z, one);
    const Float v[4] = {shuffle<0, 1, 4, 5>(xy, zw), shuffle<2, 3, 6, 7>(xy, zw),
                        shuffle<0, 1, 4, 5>(xy2, zw2), shuffle<2, 3, 6, 7>(xy2, zw2)};
    store<4>(to, v);
  }

  /// The same for elements of 16 bits in the low halves of lanes.
  static ANICODEC_INLINE void interleave4(Int x, Int y, Int z, Int one, unsigned char* to) {
#if defined(ANICODEC_BIG_ENDIAN)
    const Int xy = (x << 16) | (y & 0xffff), zw = (z << 16) | (one & 0xffff);
#else
    const Int xy = (x & 0xffff) | (y << 16), zw = (z & 0xffff) | (one << 16);
#endif
    const Int v[2] = {shuffle<0, 4, 1, 5>(xy, zw), shuffle<2, 6, 3, 7>(xy, zw)};
    store<2>(to, v);
  }

  /// round(x) for x clamped to low .. high; bias is such that x + bias is positive.
  static ANICODEC_INLINE Int normalised(Float x, float low, float high, float bias,
                                        int32_t integer_bias) {
    const Float l = Float{} + low, h = Float{} + high;
    x = x > l ? x : l;
    x = x < h ? x : h;
    return ANICODEC_CONVERT(x + bias, Int) - integer_bias;
  }

  struct Half {
    static ANICODEC_INLINE Int convert(Float x) {
#if defined(__F16C__) && defined(__AVX2__)
      if constexpr (W == 8)
        return reinterpret_cast<Int>(
            _mm256_cvtepu16_epi32(_mm256_cvtps_ph(x, _MM_FROUND_TO_NEAREST_INT)));
#endif
#if defined(__AVX512F__)
      if constexpr (W == 16) {
        const auto all = static_cast<__mmask16>(-1);  // GCC 12 warns where there is no mask
        return reinterpret_cast<Int>(_mm512_maskz_cvtepu16_epi32(
            all, _mm512_maskz_cvtps_ph(all, x, _MM_FROUND_TO_NEAREST_INT)));
      }
#endif
      return half_bits<Float, Int>(x);
    }
  };

  struct Unorm {
    static ANICODEC_INLINE Int convert(Float x) { return normalised(x, 0, 65535, 0.5F, 0); }
  };

  struct Snorm {
    static ANICODEC_INLINE Int convert(Float x) {
      return normalised(x, -32767, 32767, 32768.5F, 32768);
    }
  };

  /// All 16 vertices as elements of 16 bits, with the fourth.
  template <class Format>
  static ANICODEC_INLINE void pack(const OutputScale& scale, const Block& sums, unsigned char* to) {
    const Int one = Format::convert(Float{} + scale.one);
    for (size_t h = 0; h < kBlock; h += W) {
      Int v[3];
      ANICODEC_UNROLL for (size_t c = 0; c < 3; ++c) v[c] =
          Format::convert((load(sums[c] + h) - scale.offset[c]) * scale.factor[c]);
      interleave4(v[0], v[1], v[2], one, to + 8 * h);
    }
  }

  static ANICODEC_INLINE void pack(VertexFormat format, const OutputScale& scale, const Block& sums,
                                   unsigned char* to) {
    switch (format) {
      case VertexFormat::kFloat32x3:
      case VertexFormat::kFloat32x4:
        for (size_t h = 0; h < kBlock; h += W)
          interleave4(load(sums[0] + h), load(sums[1] + h), load(sums[2] + h), to + 16 * h);
        return;
      case VertexFormat::kFloat16x3:
      case VertexFormat::kFloat16x4:
        return pack<Half>(scale, sums, to);
      case VertexFormat::kUnorm16x3:
      case VertexFormat::kUnorm16x4:
        return pack<Unorm>(scale, sums, to);
      case VertexFormat::kSnorm16x3:
      case VertexFormat::kSnorm16x4:
        return pack<Snorm>(scale, sums, to);
    }
  }

  /// Copies the first `Bytes` of points of `Size` bytes each.
  template <size_t Size, size_t Bytes>
  static ANICODEC_INLINE void scatter(const unsigned char* from, uint32_t count, size_t stride,
                                      unsigned char* to) {
    for (uint32_t i = 0; i < count; ++i, from += Size, to += stride)
      ANICODEC_COPY(to, from, Bytes);
  }

  static void write(const PlayJob::Frame& frame, const Block& sums, uint32_t begin, uint32_t end,
                    unsigned char* to) {
    const VertexFormat format = frame.format;
    const bool whole = begin == 0 && end == kBlock;
    if (format == VertexFormat::kFloat32x3 && frame.stride == 12) {
      alignas(32) unsigned char points[12 * kBlock];
      unsigned char* const from = whole ? to : points;
      for (size_t h = begin / W * W; h < end; h += W)
        interleave3(load(sums[0] + h), load(sums[1] + h), load(sums[2] + h), from + 12 * h);
      if (!whole)
        ANICODEC_COPY(to, points + 12 * size_t{begin}, 12 * size_t{end - begin});
      return;
    }
#if defined(ANICODEC_SMALL)
    write_scalar(frame, sums, begin, end, to);
#else
    const auto id = static_cast<uint32_t>(format);
    const bool fourth = id % 2;
    const size_t size = id < 2 ? 16 : 8;  // with the fourth
    if (whole && fourth && frame.stride == size)
      return pack(format, frame.scale, sums, to);
    alignas(32) unsigned char points[16 * kBlock];
    pack(format, frame.scale, sums, points);
    const unsigned char* from = points + begin * size;
    const uint32_t count = end - begin;
    if (size == 16)
      fourth ? scatter<16, 16>(from, count, frame.stride, to)
             : scatter<16, 12>(from, count, frame.stride, to);
    else
      fourth ? scatter<8, 8>(from, count, frame.stride, to)
             : scatter<8, 6>(from, count, frame.stride, to);
#endif
  }
};

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_OUTPUT_LANES_H_
