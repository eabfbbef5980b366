// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_FRAME_NORMALS_H_
#define ANICODEC_CODEC_SEQUENCE_FRAME_NORMALS_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "sdk/play/normal_plan.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Normals of the frames of a clip, made from its positions: a corner has one with those that
/// clip.shared_normals says, or if it says nothing with all at its vertex.
class FrameNormals {
 public:
  explicit FrameNormals(const MeshSequence& clip);

  size_t size() const { return first_corner_.size(); }

  /// Which normal a corner of the polygons has.
  uint32_t of_corner(uint32_t corner) const { return plan_.group[corner]; }

  /// The normals of a frame, three floats each, from its positions (vertices x 3); (0, 0, 1) where
  /// areas cancel.
  std::vector<float> compute(std::span<const float> positions) const;

 private:
  NormalPlan plan_;
  std::vector<uint32_t> first_corner_;  ///< of each normal
};

/// Angles between the normals of two clips, in degrees, over all normals and frames.
struct NormalError {
  double mean = 0;
  double max = 0;
};

/// Compares the normals of `clip`, made from the positions of `a`, with those of `b`; both sources
/// are asked for each frame once, in order. Cost: O(corners x frames).
NormalError normal_error(const MeshSequence& clip, const FrameSource& a, const FrameSource& b);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_FRAME_NORMALS_H_
