// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The playing kernels for vectors of 512 bits, chosen at run time. Built with -mavx2 -mfma -mf16c
// -mavx512f -mavx512vl -mprefer-vector-width=512.
#include "sdk/play/play_lanes.h"

#if defined(ANICODEC_PLAY_AVX2)

namespace anicodec {

const PlayKernels kPlayKernelsAvx512 = {"avx512", kFused, play_job<LaneKernel<16>>};

}  // namespace anicodec

#endif
