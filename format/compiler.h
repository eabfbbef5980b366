// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// All that the decoder asks of a compiler beyond C++17: GCC and Clang have it, on Windows as MinGW and clang-cl. Macros, as
// kernels that are compiled once per instruction set call no function of another header.
#ifndef ANICODEC_FORMAT_COMPILER_H_
#define ANICODEC_FORMAT_COMPILER_H_

#include <cstdint>

#if !defined(__GNUC__) && !defined(__clang__)
#error \
    "GCC or Clang is needed, on Windows MinGW or clang-cl: the kernels are written in their vectors"
#endif

// Predictions are exact only without fused multiply-add that the source does not ask for. Clang, which fuses unless it is told
// not to, obeys this; GCC has the flag -ffp-contract=off alone.
#if defined(__clang__)
#pragma clang fp contract(off)
#endif

#define ANICODEC_INLINE inline __attribute__((always_inline))
/// Before small loops with constant bounds over registers, which must be unrolled at every optimisation level.
#define ANICODEC_UNROLL _Pragma("GCC unroll 8")
#define ANICODEC_PREFETCH(address) __builtin_prefetch(address)
/// memcpy() and memset() that are never a call of an inline function.
#define ANICODEC_COPY(to, from, size) __builtin_memcpy(to, from, size)
#define ANICODEC_CLEAR(to, size) __builtin_memset(to, 0, size)
#define ANICODEC_SQUARE_ROOT(x) __builtin_sqrtf(x)

/// typedef float Four ANICODEC_VECTOR(16); loose ones lie anywhere that is aligned so, among numbers of other types.
#define ANICODEC_VECTOR(bytes) __attribute__((vector_size(bytes)))
#define ANICODEC_LOOSE_VECTOR(bytes, alignment) \
  __attribute__((vector_size(bytes), aligned(alignment), may_alias))
#define ANICODEC_CONVERT(vector, Type) __builtin_convertvector(vector, Type)
#define ANICODEC_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)

/// Vertices at once by the instruction set that is compiled for; vectors of floats that it lacks would become slow code, and
/// take minutes to compile. ANICODEC_LANES decides instead where it is defined.
#if defined(ANICODEC_LANES)
#define ANICODEC_PORTABLE_LANES ANICODEC_LANES
#elif defined(__AVX__)
#define ANICODEC_PORTABLE_LANES 8
#elif defined(__SSE2__) || defined(__aarch64__) || defined(__wasm_simd128__)
#define ANICODEC_PORTABLE_LANES 4
#else
#define ANICODEC_PORTABLE_LANES 1
#endif

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define ANICODEC_BIG_ENDIAN 1
#endif

namespace anicodec {

/// @pre x is not 0
constexpr int highest_bit(uint32_t x) {
  return 31 - __builtin_clz(x);
}

/// @pre x is not 0
constexpr int lowest_bit(uint32_t x) {
  return __builtin_ctz(x);
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_COMPILER_H_
