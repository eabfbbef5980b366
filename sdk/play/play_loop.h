// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The loop over the blocks of a range that all playing kernels share. The including file is
// compiled once per instruction set: see lanes.h.
#ifndef ANICODEC_SDK_PLAY_PLAY_LOOP_H_
#define ANICODEC_SDK_PLAY_PLAY_LOOP_H_

#include "sdk/base/lanes.h"
#include "sdk/play/play_job.h"

namespace anicodec {
namespace {

/// Coordinates of the vertices of a block.
typedef float Block[3][kBlock];

/// The kernel makes F frames of B blocks that follow each other:
///   sums<F, channels, B>(job, block, begin, end, sums, direct) combines base and components of the
///     vertices begin .. end - 1, and maybe of those beside them; to sums[b * F + f], or as three
///     floats without gaps to `direct` unless that is null;
///   move(map, sums) maps the points of one frame of a block by a 3 x 4 matrix;
///   write(frame, sums, begin, end, to) stores the vertices begin .. end - 1 of the block.
/// B is 1, or blocks_together(F, channels) where so many whole ones are left.
template <class Kernel, uint32_t F, uint32_t Channels>
class FrameLoop {
 public:
  explicit FrameLoop(const PlayJob& job) : job_(job) {
    for (uint32_t f = 0; f < F; ++f) {
      const PlayJob::Frame& frame = job.frame[f];
      correction_[f] = frame.correction;
      out_[f] = frame.out;
      plain_ &= !frame.motion && frame.format == VertexFormat::kFloat32x3 && frame.stride == 12;
    }
  }

  void run() {
    constexpr uint32_t kTogether = Kernel::blocks_together(F, Channels);
    for (uint32_t block = job_.first / kBlock; block * kBlock < job_.end;) {
      const uint32_t base = block * kBlock;
      if (kTogether > 1 && job_.first <= base && job_.end - base >= kTogether * kBlock) {
        make<kTogether>(block);
        block += kTogether;
      } else {
        make<1>(block);
        ++block;
      }
    }
  }

 private:
  bool corrected(uint32_t f, uint32_t end) const {
    return correction_[f] != job_.frame[f].corrections_end && correction_[f]->vertex < end;
  }

  /// B blocks, all whole unless B is 1.
  template <uint32_t B>
  ANICODEC_INLINE void make(uint32_t block) {
    const uint32_t base = block * kBlock;
    const uint32_t begin = job_.first > base ? job_.first - base : 0;
    const uint32_t end = job_.end - base < B * kBlock ? job_.end - base : B * kBlock;
    bool direct = plain_ && end - begin == B * kBlock;
    for (uint32_t f = 0; f < F; ++f)
      direct &= !corrected(f, base + end);
    alignas(64) Block sums[B * F];
    // Vertices beside the range are needed only where all of a block are moved or converted.
    Kernel::template sums<F, Channels, B>(job_, block, plain_ ? begin : 0,
                                          plain_ ? end : B * kBlock, sums, direct ? out_ : nullptr);
    for (uint32_t f = 0; f < F; ++f) {
      const size_t stride = job_.frame[f].stride;
      if (direct) {
        out_[f] += stride * B * kBlock;
        continue;
      }
      for (uint32_t b = 0; b < B; ++b) {
        const uint32_t last = B == 1 ? end : kBlock;
        finish(f, base + b * kBlock, begin, last, sums[b * F + f]);
        out_[f] += stride * (last - begin);
      }
    }
  }

  /// Moves, corrects and stores the vertices begin .. end - 1 of the block that begins at `base`.
  void finish(uint32_t f, uint32_t base, uint32_t begin, uint32_t end, Block& sums) {
    const PlayJob::Frame& frame = job_.frame[f];
    if (frame.motion)
      Kernel::move(frame.motion, sums);
    for (; corrected(f, base + end); ++correction_[f]) {
      for (uint32_t c = 0; c < 3; ++c)
        sums[c][correction_[f]->vertex - base] += correction_[f]->delta[c];
    }
    Kernel::write(frame, sums, begin, end, out_[f]);
  }

  const PlayJob& job_;
  const Segment::Correction* correction_[F];
  unsigned char* out_[F];
  bool plain_ = true;  // all go where a kernel may store them directly
};

template <class Kernel, uint32_t F, uint32_t Channels>
void play_frames(const PlayJob& job) {
  FrameLoop<Kernel, F, Channels>(job).run();
}

/// Kernels for F frames and fewer.
template <class Kernel, uint32_t Channels, uint32_t F>
void combine_channels(const PlayJob& job) {
  if constexpr (F > 1) {
    if (job.frames < F)
      return combine_channels<Kernel, Channels, F - 1>(job);
  }
  play_frames<Kernel, F, Channels>(job);
}

template <class Kernel>
void play_job(const PlayJob& job) {
  if (job.channels == 1)
    combine_channels<Kernel, 1, kMaxPlayedFrames>(job);
  else
    combine_channels<Kernel, 3, kMaxPlayedFrames>(job);
}

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_PLAY_LOOP_H_
