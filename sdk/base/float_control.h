// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The floating-point environment that bit-exact arithmetic needs, whatever the caller has set.
#ifndef ANICODEC_SDK_BASE_FLOAT_CONTROL_H_
#define ANICODEC_SDK_BASE_FLOAT_CONTROL_H_

#include <cfenv>
#include <cfloat>
#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#if FLT_EVAL_METHOD != 0
#error "float must be evaluated as binary32: build for SSE2 (-msse2 -mfpmath=sse)"
#endif

namespace anicodec {

/// For its lifetime: round to nearest even, subnormals kept, no traps. Engines change these.
class [[maybe_unused]] FloatControl {
 public:
#if defined(__SSE2__)
  FloatControl() : saved_(_mm_getcsr()) {
    _mm_setcsr(0x1f80);
  }

  ~FloatControl() {
    _mm_setcsr(saved_);
  }
#elif defined(__aarch64__)
  FloatControl() {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    asm volatile("msr fpcr, %0" : : "r"(uint64_t{0}));
  }

  ~FloatControl() {
    asm volatile("msr fpcr, %0" : : "r"(saved_));
  }
#elif !defined(__wasm__)  // which has no other environment
  FloatControl() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }

  ~FloatControl() {
    std::fesetenv(&saved_);
  }
#else
  FloatControl() = default;
  ~FloatControl() = default;
#endif
  FloatControl(const FloatControl&) = delete;
  FloatControl& operator=(const FloatControl&) = delete;

 private:
#if defined(__SSE2__)
  unsigned saved_;
#elif defined(__aarch64__)
  uint64_t saved_;
#elif !defined(__wasm__)
  std::fenv_t saved_;
#endif
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_FLOAT_CONTROL_H_
