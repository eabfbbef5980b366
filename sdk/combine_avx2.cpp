// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The playing kernels for AVX2, chosen at run time. Built with -mavx2 -mfma -mf16c.
#include "sdk/combine_lanes.h"

#if defined(ANICODEC_COMBINE_AVX2)

namespace anicodec {

const CombineKernels kCombineKernelsAvx2 = {"avx2", kFused, combine_job<LaneKernel<8>>};

}  // namespace anicodec

#endif
