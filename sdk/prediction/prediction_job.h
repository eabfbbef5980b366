// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The work of the prediction kernels of every instruction set. Internal to sdk/.
#ifndef ANICODEC_SDK_PREDICTION_PREDICTION_JOB_H_
#define ANICODEC_SDK_PREDICTION_PREDICTION_JOB_H_

#if defined(ANICODEC_PREDICTION_AVX2)
#include "sdk/base/cpu_features.h"
#endif

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Most samples that a prior is renewed from: they are at hand together in every kernel.
constexpr size_t kMaxRenewalSamples = 30;

/// Ranks count vertices in decoding order; a sample is one channel of one component.
struct PredictionJob {
  int neighbour_count = 0;
  size_t vertices = 0;
  size_t samples = 0;                   // components x channels
  const int32_t* neighbours = nullptr;  // ranks x neighbour_count
  const float* positions = nullptr;     // ranks x 3
  float radius = 0;
  const float* omega = nullptr;    // samples
  const size_t* refits = nullptr;  // number of samples before each refit, ascending
  size_t refit_count = 0;
  float alike = 0;                   // squared weight of motion in a renewed prior; 0: none is
  const size_t* renewals = nullptr;  // those of the refits that renew the prior first
  size_t renewal_count = 0;
  size_t wide_samples = 0;        // the first ones have 32-bit integers, the others 16-bit
  const int32_t* wide = nullptr;  // wide samples x vertices
  const int16_t* narrow = nullptr;
  float* y = nullptr;  // (vertices + 1) x stride; the last row is 0
  size_t stride = 0;   // at least samples, a multiple of 8
  // learnt_floats() x vertices; null: priors come from the positions; nothing is handed on.
  const float* continued = nullptr;
  float* learnt = nullptr;
};

/// The state of the vertices while they are encoded, one component after the other.
struct EncoderJob {
  int neighbour_count = 0;
  size_t vertices = 0;
  size_t channels = 0;
  const int32_t* neighbours = nullptr;
  const float* positions = nullptr;
  float radius = 0;
  float* state = nullptr;    // blocks of encoder_block_rows() x lanes floats
  const float* y = nullptr;  // channels x (vertices + 1), the last of each 0: the current component
  float omega = 0;
  bool refit = false;
  bool renew = false;                // the prior, before that
  float alike = 0;                   // as PredictionJob's
  const float* continued = nullptr;  // as PredictionJob's
  const float* earlier = nullptr;    // if renew: samples of the components before, as y
  size_t earlier_samples = 0;
};

/// Floats of what a vertex' predictions with m neighbours have learnt: prior, g, packed lower triangle of A.
constexpr size_t learnt_floats(size_t m) {
  return 2 * m + m * (m + 1) / 2;
}

/// The decoder's kernel for one instruction set.
struct PredictionKernels {
  size_t lanes;
  /// Ranks [first, last), all of one level.
  void (*reconstruct)(const PredictionJob&, size_t first, size_t last);
};

/// The encoder's kernels for one instruction set: apart, so that programs that only decode can be
/// linked without them.
struct EncoderKernels {
  size_t lanes;
  /// Sets the prior weights of the blocks [first, last) of `lanes` vertices.
  void (*start_blocks)(const EncoderJob&, size_t first, size_t last);
  /// Learns from the current component.
  void (*update_blocks)(const EncoderJob&, size_t first, size_t last);
};

/// Offsets in a block, in units of `lanes` floats: weights, prior, g, packed lower triangle of A.
constexpr size_t encoder_block_rows(size_t m) {
  return 3 * m + m * (m + 1) / 2;
}

extern const PredictionKernels kPredictionKernelsPortable;
extern const EncoderKernels kEncoderKernelsPortable;
#if defined(ANICODEC_PREDICTION_AVX2)
extern const PredictionKernels kPredictionKernelsAvx2;
extern const PredictionKernels kPredictionKernelsAvx512;
extern const EncoderKernels kEncoderKernelsAvx2;
extern const EncoderKernels kEncoderKernelsAvx512;
#endif

/// The fastest of the kernels for different instruction sets that this machine runs.
#if defined(ANICODEC_PREDICTION_AVX2)
template <class Kernels>
const Kernels& fastest_kernels(const Kernels& avx512, const Kernels& avx2,
                               const Kernels& portable) {
  const CpuFeatures& cpu = cpu_features();
  return cpu.avx512f && cpu.avx512vl ? avx512 : cpu.avx2 ? avx2 : portable;
}
#endif

}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_PREDICTION_JOB_H_
