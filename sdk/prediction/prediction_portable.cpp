// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The prediction kernels for the instruction set that the library is built for.
#include "sdk/prediction/prediction_kernel.h"

namespace anicodec {

constexpr size_t kLanes = ANICODEC_PORTABLE_LANES;
static_assert(kLanes == 1 || kLanes == 4 || kLanes == 8 || kLanes == 16);

const PredictionKernels kPredictionKernelsPortable = {kLanes, reconstruct_any<kLanes>};
const EncoderKernels kEncoderKernelsPortable = {kLanes, start_any<kLanes>, update_any<kLanes>};

}  // namespace anicodec
