// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Vectors of W floats, from the compiler's vector types, for kernels that are compiled once per
// instruction set. Everything here has internal linkage or is always inlined, lest the linker pick
// a copy with the wrong instructions.
#ifndef ANICODEC_SDK_BASE_LANES_H_
#define ANICODEC_SDK_BASE_LANES_H_

#include "format/compiler.h"

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace anicodec {
namespace {

template <size_t W>
struct LaneTypes {
  // Aliases (using) lose the attribute where it depends on a template parameter (GCC).
  typedef float Float ANICODEC_VECTOR(4 * W);
  typedef float Unaligned ANICODEC_LOOSE_VECTOR(4 * W, 4);
  typedef int32_t Int ANICODEC_VECTOR(4 * W);
  typedef uint32_t Bits ANICODEC_VECTOR(4 * W);
};

/// Every lane, rounded to nearest.
template <typename V>
ANICODEC_INLINE V square_root(V x) {
#if defined(__AVX512F__)
  if constexpr (sizeof(V) == 64)
    return reinterpret_cast<V>(_mm512_maskz_sqrt_ps(0xFFFF, reinterpret_cast<__m512>(x)));
#endif
#if defined(__AVX__)
  if constexpr (sizeof(V) == 32)
    return reinterpret_cast<V>(_mm256_sqrt_ps(reinterpret_cast<__m256>(x)));
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(V) == 16)
    return reinterpret_cast<V>(_mm_sqrt_ps(reinterpret_cast<__m128>(x)));
#elif defined(__wasm_simd128__)
  if constexpr (sizeof(V) == 16)
    return reinterpret_cast<V>(wasm_f32x4_sqrt(reinterpret_cast<v128_t>(x)));
#endif
  for (size_t l = 0; l < sizeof(V) / sizeof(float); ++l)
    x[l] = ANICODEC_SQUARE_ROOT(x[l]);
  return x;
}

#if defined(__wasm_simd128__)
/// Four integers as floats. LLVM 14 would join both conversions, and make scalar code of that.
ANICODEC_INLINE LaneTypes<4>::Float widened_four(const int16_t* q) {
  v128_t v = wasm_i32x4_load16x4(q);
  __asm__("" : "+r"(v));
  return reinterpret_cast<LaneTypes<4>::Float>(wasm_f32x4_convert_i32x4(v));
}
#endif

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_LANES_H_
