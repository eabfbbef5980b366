// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The playing kernels for the instruction set that the library is built for.
#include "format/compiler.h"

#if ANICODEC_PORTABLE_LANES == 1

#include "sdk/play/play_job.h"

namespace anicodec {

const PlayKernels kPlayKernelsPortable = {"scalar", false, play_scalar};

}  // namespace anicodec

#else

#include "sdk/play/play_lanes.h"

namespace anicodec {

#if defined(__AVX512F__)
constexpr size_t kWidest = 16;
#elif defined(__aarch64__)
constexpr size_t kWidest = 4;
#else
constexpr size_t kWidest = 8;
#endif
constexpr size_t kLanes = ANICODEC_PORTABLE_LANES < kWidest ? ANICODEC_PORTABLE_LANES : kWidest;
static_assert(kLanes == 4 || kLanes == 8 || kLanes == 16);

const PlayKernels kPlayKernelsPortable = {"portable", kFused, play_job<LaneKernel<kLanes>>};

}  // namespace anicodec

#endif
