// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The playing kernels for AVX-512, chosen at run time: vectors of 256 bits, which leave the clock
// alone, but 32 registers for them. Built with -mavx2 -mfma -mf16c -mavx512f -mavx512vl.
#include "sdk/combine_lanes.h"

#if defined(ANICODEC_COMBINE_AVX2)

namespace anicodec {

const CombineKernels kCombineKernelsAvx512 = {"avx512", kFused, combine_job<LaneKernel<8>>};

}  // namespace anicodec

#endif
