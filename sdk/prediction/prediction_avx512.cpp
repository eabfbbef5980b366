// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The prediction kernels for AVX-512, chosen when the library starts to decode. Built with -mavx2
// -mavx512f -mavx512vl.
#include "sdk/prediction/prediction_kernel.h"

#if defined(ANICODEC_PREDICTION_AVX2)

namespace anicodec {

const PredictionKernels kPredictionKernelsAvx512 = {16, reconstruct_any<16>};
const EncoderKernels kEncoderKernelsAvx512 = {16, start_any<16>, update_any<16>};

}  // namespace anicodec

#endif
