// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_MASSAGE_QUALITY_H_
#define ANICODEC_CODEC_MASSAGE_MASSAGE_QUALITY_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/surface/mesh_quality.h"

#include <cstdint>

namespace anicodec {

/// The triangles of a clip, all frames together (thesis figures 3.7 and 3.13).
struct MassageQuality {
  Distortion distortion;    ///< from the reference frame: mean of the means, largest of the maxima
  double radius_ratio = 0;  ///< mean
  uint64_t turned = 0;      ///< triangles that face against the surface, in all frames
};

/// Measures `sequence` as a clip on the surfaces of `surfaces`, which has the same counts and faces.
/// Distortion is relative to frame `reference` of `sequence`.
MassageQuality massage_quality(const MeshSequence& surfaces, const MeshSequence& sequence,
                               uint32_t reference);

/// The triangles of two clips, frame by frame: means over all frames, largest of all.
struct TriangleComparison {
  double radius_ratio_a = 0, radius_ratio_b = 0;
  bool mapped = false;    ///< the clips have the same faces; if not, there is no distortion
  Distortion distortion;  ///< of the triangles of a by those of b
};

/// Frames are asked for once and in order. Throws Error(kInput) for a corner out of range.
TriangleComparison compare_triangles(const Polygons& a, const FrameSource& a_frames,
                                     const Polygons& b, const FrameSource& b_frames,
                                     uint32_t frame_count);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_MASSAGE_QUALITY_H_
