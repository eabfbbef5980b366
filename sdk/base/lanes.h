// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Vectors of W floats, from the compiler's vector types, for kernels that are compiled once per
// instruction set. Everything here has internal linkage or is always inlined, lest the linker pick
// a copy with the wrong instructions.
#ifndef ANICODEC_SDK_BASE_LANES_H_
#define ANICODEC_SDK_BASE_LANES_H_

#include <cstddef>
#include <cstdint>

namespace anicodec {
namespace {

template <size_t W>
struct LaneTypes {
  // Aliases (using) lose the attribute where it depends on a template parameter (GCC).
  typedef float Float __attribute__((vector_size(4 * W)));
  typedef float Unaligned __attribute__((vector_size(4 * W), aligned(4), may_alias));
  typedef int32_t Int __attribute__((vector_size(4 * W)));
  typedef uint32_t Bits __attribute__((vector_size(4 * W)));
};

}  // namespace
}  // namespace anicodec

// Small loops with constant bounds over registers must be unrolled, at every optimisation level.
#define ANICODEC_INLINE inline __attribute__((always_inline))
#define ANICODEC_UNROLL _Pragma("GCC unroll 8")

#endif  // ANICODEC_SDK_BASE_LANES_H_
