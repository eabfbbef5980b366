// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The loop over the blocks of a range that all playing kernels share. The including file is
// compiled once per instruction set: see lanes.h.
#ifndef ANICODEC_SDK_COMBINE_LOOP_H_
#define ANICODEC_SDK_COMBINE_LOOP_H_

#include "sdk/combine_job.h"
#include "sdk/lanes.h"

namespace anicodec {
namespace {

/// Coordinates of the vertices of a block.
typedef float Block[3][kBlock];

/// Kernel::sums<F>(job, block, sums) makes F frames of a block without corrections;
/// Kernel::write(frame, sums, begin, end, to) stores the vertices begin .. end - 1 of a block.
template <class Kernel, uint32_t F>
void combine_frames(const CombineJob& job) {
  const Segment::Correction* correction[F];
  unsigned char* out[F];
  for (uint32_t f = 0; f < F; ++f) {
    correction[f] = job.frame[f].correction;
    out[f] = job.frame[f].out;
  }
  for (uint32_t block = job.first / kBlock; block * kBlock < job.end; ++block) {
    const uint32_t base = block * kBlock;
    const uint32_t begin = job.first > base ? job.first - base : 0;
    const uint32_t end = job.end - base < kBlock ? job.end - base : kBlock;
    alignas(64) Block sums[F];
    Kernel::template sums<F>(job, block, sums);
    for (uint32_t f = 0; f < F; ++f) {
      const CombineJob::Frame& frame = job.frame[f];
      for (; correction[f] != frame.corrections_end && correction[f]->vertex < base + end;
           ++correction[f]) {
        for (uint32_t c = 0; c < 3; ++c)
          sums[f][c][correction[f]->vertex - base] += correction[f]->delta[c];
      }
      Kernel::write(frame, sums[f], begin, end, out[f]);
      out[f] += frame.stride * (end - begin);
    }
  }
}

template <class Kernel>
void combine_job(const CombineJob& job) {
  switch (job.frames) {
    case 1:
      return combine_frames<Kernel, 1>(job);
    case 2:
      return combine_frames<Kernel, 2>(job);
    case 3:
      return combine_frames<Kernel, 3>(job);
    case 4:
      return combine_frames<Kernel, 4>(job);
    default:
      return;
  }
}

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_COMBINE_LOOP_H_
