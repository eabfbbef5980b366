// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_GPU_SAMPLE_H_
#define ANICODEC_TESTS_BENCH_GPU_SAMPLE_H_

#include <anicodec/anicodec.h>

// Parts of the samples of the SDK, which are C.
extern "C" {
#include "card_clip.h"
}

#endif  // ANICODEC_TESTS_BENCH_GPU_SAMPLE_H_
