// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The playing kernels for the instruction set that the library is built for.
#if defined(ANICODEC_LANES) && ANICODEC_LANES == 1

#include "sdk/combine_job.h"

namespace anicodec {

const CombineKernels kCombineKernelsPortable = {"scalar", false, combine_scalar};

}  // namespace anicodec

#else

#include "sdk/combine_lanes.h"

namespace anicodec {

#if defined(ANICODEC_LANES)
constexpr size_t kLanes = ANICODEC_LANES;
#elif defined(__AVX__)
constexpr size_t kLanes = 8;
#else
constexpr size_t kLanes = 4;
#endif
static_assert(kLanes == 4 || kLanes == 8);

const CombineKernels kCombineKernelsPortable = {"portable", kFused,
                                                combine_job<LaneKernel<kLanes>>};

}  // namespace anicodec

#endif
