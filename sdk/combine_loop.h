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

/// The kernel makes F frames of a block:
///   sums<F, channels>(job, block, sums, direct) combines base and components; to `sums`, or as
///   three
///     floats without gaps to `direct` unless that is null;
///   move(map, sums) maps the points of one frame by a 3 x 4 matrix;
///   write(frame, sums, begin, end, to) stores the vertices begin .. end - 1 of the block.
template <class Kernel, uint32_t F, uint32_t Channels>
void combine_frames(const CombineJob& job) {
  const Segment::Correction* correction[F];
  unsigned char* out[F];
  bool plain = true;  // all go where a kernel may store them directly
  for (uint32_t f = 0; f < F; ++f) {
    const CombineJob::Frame& frame = job.frame[f];
    correction[f] = frame.correction;
    out[f] = frame.out;
    plain &= !frame.motion && frame.format == VertexFormat::kFloat32x3 && frame.stride == 12;
  }
  for (uint32_t block = job.first / kBlock; block * kBlock < job.end; ++block) {
    const uint32_t base = block * kBlock;
    const uint32_t begin = job.first > base ? job.first - base : 0;
    const uint32_t end = job.end - base < kBlock ? job.end - base : kBlock;
    const auto corrected = [&](uint32_t f) {
      return correction[f] != job.frame[f].corrections_end && correction[f]->vertex < base + end;
    };
    bool direct = plain && end - begin == kBlock;
    for (uint32_t f = 0; f < F; ++f)
      direct &= !corrected(f);
    alignas(64) Block sums[F];
    Kernel::template sums<F, Channels>(job, block, sums, direct ? out : nullptr);
    for (uint32_t f = 0; f < F; ++f) {
      const CombineJob::Frame& frame = job.frame[f];
      if (!direct) {
        if (frame.motion)
          Kernel::move(frame.motion, sums[f]);
        for (; corrected(f); ++correction[f]) {
          for (uint32_t c = 0; c < 3; ++c)
            sums[f][c][correction[f]->vertex - base] += correction[f]->delta[c];
        }
        Kernel::write(frame, sums[f], begin, end, out[f]);
      }
      out[f] += frame.stride * (end - begin);
    }
  }
}

template <class Kernel, uint32_t Channels>
void combine_channels(const CombineJob& job) {
  switch (job.frames) {
    case 1:
      return combine_frames<Kernel, 1, Channels>(job);
    case 2:
      return combine_frames<Kernel, 2, Channels>(job);
    case 3:
      return combine_frames<Kernel, 3, Channels>(job);
    case 4:
      return combine_frames<Kernel, 4, Channels>(job);
    default:
      return;
  }
}

template <class Kernel>
void combine_job(const CombineJob& job) {
  if (job.channels == 1)
    combine_channels<Kernel, 1>(job);
  else
    combine_channels<Kernel, 3>(job);
}

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_COMBINE_LOOP_H_
