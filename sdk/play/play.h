// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_PLAY_H_
#define ANICODEC_SDK_PLAY_PLAY_H_

#include "sdk/play/vertex_output.h"
#include "sdk/segment/segment.h"

#include <cstdint>

namespace anicodec {

/// The part of a segment that depends on time, at one time: a frame is the segment's basis combined with it.
/// Points into the segment, or to what the caller interpolated.
struct FrameState {
  const Segment* segment = nullptr;
  const float* weights = nullptr;    ///< regions x components of the segment x weight_channels
  const float* pose_maps = nullptr;  ///< A_f, regions x 12; null where the segment has no pose
  Affine motion;                     ///< M_f, where `moves`
  bool moves = false;                ///< the segment has motions, or the whole has one
  const Segment::Correction* corrections = nullptr;  ///< ascending by vertex
  uint32_t correction_count = 0;
  uint32_t components = 0;  ///< the first ones of the segment, which are played
  /// Coded vertices x 3: the positions, whatever else the state says.
  const float* exact = nullptr;
  const float* shape = nullptr;  ///< segments of MSGI: coded vertices x 3, before the motion
};

/// A whole frame, 0 .. frames - 1 of the segment. O(1). In a segment of MSGI, where it lacks what
/// make_shape() computes.
FrameState frame_state(const Segment& segment, uint32_t frame);

/// Weights of a region in a frame: components x weight_channels.
size_t region_weights(const Segment& segment);

/// How many of the segment's components are played at a quality in (0, 1]; key-frames are, all.
uint32_t played_components(const Segment& segment, double quality);

/// Floats that make_shape() fills, and floats that it works in, which states may share; 0 for
/// segments that are not of MSGI.
size_t shape_size(const Segment& segment);
size_t shape_scratch_size(const Segment& segment);

/// Bytes of those floats, by what the limits say of the segment.
uint64_t shape_scratch_bytes(uint64_t components, uint64_t msgi_frame_bytes);

/// In a segment of MSGI, computes the mesh that the state's weights ask for and keeps it in
/// `shape`, which the state then points to. Nothing to do in others. Cost: that of
/// Msgi::evaluate().
void make_shape(FrameState* state, float* shape, float* scratch);

/// Stores the positions of the vertices first .. first + count - 1 of the segment in `count`
/// frames: that of vertex `first` in frame i goes to outputs[i].data. Each output is written once
/// and in order, and not read; the outputs must not overlap, and must be valid (is_valid()). States
/// of a segment of MSGI must have a shape.
///
/// A position is within the tolerance of spec/09a-segments.md, section 7, and on one machine it has
/// the same bits whatever the range and whatever other frames are made with it. Allocates nothing;
/// any number of threads may do so at the same time. Cost: O(vertices x components) per frame, the
/// same for every frame. Frames of one segment that follow each other share passes over its
/// coefficients, four at most, which takes about half the time of one by one.
void play(const FrameState* states, uint32_t frames, uint32_t first, uint32_t count,
          const VertexOutput* outputs);

/// One frame, three floats for each vertex, without gaps.
void play(const FrameState& state, uint32_t first, uint32_t count, float* out);

/// Stores points made otherwise, as play() does: points first .. first + count - 1 of `blocks`,
/// in the layout of Segment::pose.
void store_points(const float* blocks, uint32_t first, uint32_t count, const VertexOutput& output);

/// The kernel that play() runs on this machine: "avx512", "avx512vl", "avx2", "portable" (the instruction
/// set of the build) or "scalar".
const char* play_kernels_name();

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_PLAY_H_
