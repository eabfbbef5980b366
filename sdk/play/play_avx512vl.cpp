// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The playing kernels for the first machines with AVX-512, whose clock is lower while they multiply
// vectors of 512 bits: vectors of 256 bits, but 32 registers for them. Built with -mavx2 -mfma
// -mf16c -mavx512f -mavx512vl.
#include "sdk/play/play_lanes.h"

#if defined(ANICODEC_PLAY_AVX2)

namespace anicodec {

const PlayKernels kPlayKernelsAvx512vl = {"avx512vl", kFused, play_job<LaneKernel<8>>};

}  // namespace anicodec

#endif
