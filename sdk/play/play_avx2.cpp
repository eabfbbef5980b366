// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The playing kernels for AVX2, chosen at run time. Built with -mavx2 -mfma -mf16c.
#include "sdk/play/play_lanes.h"

#if defined(ANICODEC_PLAY_AVX2)

namespace anicodec {

const PlayKernels kPlayKernelsAvx2 = {"avx2", kFused, play_job<LaneKernel<8>>};

}  // namespace anicodec

#endif
