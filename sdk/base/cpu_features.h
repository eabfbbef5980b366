// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_BASE_CPU_FEATURES_H_
#define ANICODEC_SDK_BASE_CPU_FEATURES_H_

namespace anicodec {

/// Instruction sets that an x86 machine runs: the processor has them, and the system saves their registers. All are false on
/// other machines.
struct CpuFeatures {
  bool avx2 = false, fma = false, f16c = false;
  bool avx512f = false, avx512vl = false, avx512vbmi2 = false;
};

/// Asks the machine once: compilers' own answers differ (that of Zig's runtime is always no).
const CpuFeatures& cpu_features();

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_CPU_FEATURES_H_
