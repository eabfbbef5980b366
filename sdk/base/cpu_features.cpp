// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/base/cpu_features.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

namespace anicodec {
namespace {

#if defined(__x86_64__) || defined(__i386__)
struct Registers {
  unsigned a = 0, b = 0, c = 0, d = 0;
};

/// All 0 where the processor has no such leaf.
Registers cpuid(unsigned leaf) {
  Registers r;
  if (!__get_cpuid_count(leaf, 0, &r.a, &r.b, &r.c, &r.d))
    return {};
  return r;
}

bool has(unsigned bits, int bit) {
  return bits >> bit & 1;
}

/// Registers that the system saves when it switches threads: XCR0.
unsigned saved_registers() {
  unsigned low, high;
  __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
}

CpuFeatures detect() {
  CpuFeatures found;
  const Registers one = cpuid(1), seven = cpuid(7);
  const bool tells = has(one.c, 27);  // OSXSAVE: xgetbv is there
  const unsigned saved = tells ? saved_registers() : 0;
  if ((saved & 0x6) != 0x6 || !has(one.c, 28))  // vectors of 256 bits
    return found;
  found.fma = has(one.c, 12);
  found.f16c = has(one.c, 29);
  found.avx2 = has(seven.b, 5);
  if ((saved & 0xE0) != 0xE0)  // of 512 bits, and masks
    return found;
  found.avx512f = has(seven.b, 16);
  found.avx512vl = has(seven.b, 31);
  found.avx512vbmi2 = has(seven.c, 6);
  return found;
}
#else
CpuFeatures detect() {
  return {};
}
#endif

}  // namespace

const CpuFeatures& cpu_features() {
  static const CpuFeatures found = detect();
  return found;
}

}  // namespace anicodec
