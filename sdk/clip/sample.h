// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_SAMPLE_H_
#define ANICODEC_SDK_CLIP_SAMPLE_H_

#include "sdk/clip/clip.h"
#include "sdk/clip/clock.h"
#include "sdk/play/play.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// A track at one time: the sum over its parts of share * play(part). One part for each segment
/// that the frames of the time are in; none when the mesh is not there, or the attribute is as in
/// frame 0 (spec/10-seeking.md, section 2).
struct Sample {
  static constexpr uint32_t kMaxParts = 4;

  uint32_t count = 0;
  FrameState parts[kMaxParts];
  float share[kMaxParts] = {};

  /// Stores the positions of vertices first .. first + vertices - 1; see play(). Cost:
  /// O(vertices x components) for each part. Allocates nothing.
  void positions(uint32_t first, uint32_t vertices, const VertexOutput& output) const;

  /// Adds, for an attribute, to the values of vertices first .. first + vertices - 1, vertices x
  /// components. Cost as above.
  void add_motion(uint32_t components, uint32_t first, uint32_t vertices, float* values) const;
};

/// How many parts the sample of a mix would have; make_sample() can make Sample::kMaxParts.
uint32_t part_count(const Clip& clip, uint32_t track, const FrameMix& mix);

/// Floats of a part that is made of several frames: weights, and maps of the pose.
size_t mixed_floats(const Segment& segment);

/// The motion of the whole at a time, left out of the positions or not. No motion in clips that
/// have none. Cost: O(frames of the mix x log clips).
RootState root_state(const Clip& clip, const FrameMix& mix);

/// Combines what depends on time. `buffer` holds sample_size().buffer() floats and must outlive the
/// sample, as the clip must; `scratch` holds sample_size().scratch
/// bytes. Rigid motions turn the shorter
/// way; corrections are there when the mix is one frame. Frames in which the mesh is missing drop
/// out; without the first one, the sample is empty. Frames without an attribute's segment add
/// nothing. `quality` in (0, 1] is the share of a segment's components to be played. Cost:
/// O(components) per frame; in a segment of MSGI one evaluation for each part. Allocates nothing.
Sample make_sample(const Clip& clip, uint32_t track, const FrameMix& mix, float* buffer,
                   float* scratch, double quality = 1);

/// Stores the positions of all vertices of a mesh in one frame as a context shows them, three floats
/// each. Errors: kFrameRange; kAbsent: the mesh is not there. Cost: O(vertices x components), the
/// same for every frame. Allocates nothing, but in a segment of MSGI.
Status show_positions(const Clip& clip, uint32_t mesh, uint32_t frame, float* out);

/// Stores the values of an attribute of numbers in one frame, elements x components, moving or not.
/// Errors: kFrameRange; kArgument: no such attribute. Cost: as show_positions(), for each track.
Status show_attribute(const Clip& clip, uint32_t mesh, uint32_t attribute, uint32_t frame,
                      float* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_SAMPLE_H_
