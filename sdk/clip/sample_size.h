// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The memory of samples and contexts, from an open clip or from the limits of a file: one formula
// for both.
#ifndef ANICODEC_SDK_CLIP_SAMPLE_SIZE_H_
#define ANICODEC_SDK_CLIP_SAMPLE_SIZE_H_

#include "sdk/clip/clip.h"

#include <cstdint>

namespace anicodec {

/// Sizes of the samples of one track, by its segments.
struct SampleSize {
  uint64_t weights = 0;  ///< mixed_floats() of the segment that has most
  uint64_t shape = 0;    ///< floats of a shape of MSGI
  uint64_t scratch = 0;  ///< bytes that make_sample() works in and leaves to others afterwards
  uint64_t segments = 0;
  uint64_t shapes = 0;  ///< segments of MSGI

  void include(const SampleSize& segment);

  /// Floats that a sample keeps: interpolated weights, and the shapes in segments of MSGI.
  uint64_t buffer() const;
};

/// Sizes for a track of an open clip. O(segments of the track).
SampleSize sample_size(const Clip& clip, uint32_t track);

/// Memory of a context behind its struct: two samples of each track, and scratch.
struct ContextSize {
  uint64_t tracks = 0;
  uint64_t buffers = 0;  ///< floats that one sample of each track keeps
  uint64_t scratch = 0;  ///< bytes, shared by all

  void add(const SampleSize& track);
  uint64_t bytes() const;
};

ContextSize context_size(const Clip& clip);

/// The same, before the file is opened at a quality; O(meshes + segments).
ContextSize context_size(const Limits& limits, double quality);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_SAMPLE_SIZE_H_
