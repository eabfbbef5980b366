// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The work of the playing kernels of every instruction set. Internal to sdk/.
#ifndef ANICODEC_SDK_PLAY_PLAY_JOB_H_
#define ANICODEC_SDK_PLAY_PLAY_JOB_H_

#include "sdk/play/play.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Frames that one pass over the coefficients makes.
#if defined(ANICODEC_SMALL)
// Kernels for more are as large as all else of playing.
inline constexpr uint32_t kMaxPlayedFrames = 1;
#else
inline constexpr uint32_t kMaxPlayedFrames = 4;
#endif

/// The 16-bit formats store (x - offset) * factor, rounded and, but for halves, clamped.
struct OutputScale {
  float offset[3];
  float factor[3];
  float one;  // what is stored for 1
};

struct PlayJob {
  struct Frame {
    const float* weights = nullptr;                   // (wide + narrow) x weight channels
    const float* pose_map = nullptr;                  // 3 x 4; where there is a pose
    const float* motion = nullptr;                    // 3 x 4; null: none
    const Segment::Correction* correction = nullptr;  // the first one of the range
    const Segment::Correction* corrections_end = nullptr;
    unsigned char* out = nullptr;  // where vertex `first` goes
    size_t stride = 0;
    VertexFormat format = VertexFormat::kFloat32x3;
    OutputScale scale = {};
  };

  uint32_t channels = 3;                  // of a coefficient: 3, or 1 and three weights
  uint32_t wide_row = 0, narrow_row = 0;  // components in a block
  uint32_t wide_components = 0, narrow_components = 0;  // the first ones of them, which are played
  const int32_t* wide = nullptr;                        // blocks x wide_row x channels x 16
  const int16_t* narrow = nullptr;                      // blocks x narrow_row x channels x 16
  const float* pose = nullptr;  // blocks x 3 x 16; null: the base is `origin`
  float origin[3] = {0, 0, 0};
  uint32_t first = 0, end = 0;  // vertices
  uint32_t frames = 0;          // 1 .. kMaxPlayedFrames, all of one segment
  Frame frame[kMaxPlayedFrames];
};

/// Kernels for one instruction set.
struct PlayKernels {
  const char* name;
  bool fused;  // sums are fused multiply-adds; kernels that agree in this agree in every bit
  void (*play)(const PlayJob&);
};

/// The fastest kernels that this machine runs.
const PlayKernels& play_kernels();

/// All kernels that this machine runs, the scalar ones first; returns how many.
inline constexpr size_t kMaxPlayKernels = 5;
size_t all_play_kernels(const PlayKernels* (&out)[kMaxPlayKernels]);

/// play() with given kernels.
void play_with(const PlayKernels& kernels, const FrameState* states, uint32_t frames,
               uint32_t first, uint32_t count, const VertexOutput* outputs);

/// Stores the vertices begin .. end - 1 of a block in the frame's format, from `to` on.
void write_scalar(const PlayJob::Frame& frame, const float (&sum)[3][kBlock], uint32_t begin,
                  uint32_t end, unsigned char* to);

/// Plain loops, the reference of the others.
extern const PlayKernels kPlayKernelsScalar;
/// For the instruction set that the library is built for; plain loops too where ANICODEC_LANES
/// is 1.
extern const PlayKernels kPlayKernelsPortable;
#if defined(ANICODEC_PLAY_AVX2)
extern const PlayKernels kPlayKernelsAvx2;      // and FMA, F16C
extern const PlayKernels kPlayKernelsAvx512vl;  // F and VL, and what AVX2 needs
extern const PlayKernels kPlayKernelsAvx512;    // the same, where 512 bits are worth it
#endif

/// play of kPlayKernelsScalar.
void play_scalar(const PlayJob& job);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_PLAY_JOB_H_
