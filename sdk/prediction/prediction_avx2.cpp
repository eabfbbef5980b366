// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The prediction kernels for AVX2, chosen when the library starts to decode. Built with -mavx2.
#include "sdk/prediction/prediction_kernel.h"

#if defined(ANICODEC_PREDICTION_AVX2)

namespace anicodec {

const PredictionKernels kPredictionKernelsAvx2 = {8, reconstruct_any<8>};
const EncoderKernels kEncoderKernelsAvx2 = {8, start_any<8>, update_any<8>};

}  // namespace anicodec

#endif
