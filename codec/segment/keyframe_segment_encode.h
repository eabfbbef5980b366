// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_KEYFRAME_SEGMENT_ENCODE_H_
#define ANICODEC_CODEC_SEGMENT_KEYFRAME_SEGMENT_ENCODE_H_

#include "codec/keyframes/keyframe_fit.h"
#include "codec/segment/encoded_segment.h"
#include "codec/segment/keyframe_poses.h"

#include <cstdint>
#include <optional>

namespace anicodec {

/// Quantises a fit and codes it as a segment of the key-frame kind (thesis chapter 5).
///   step           of the grid on which the key-frames' coordinates are rounded, scene units
///   mean_position  the fit's FrameGram::mean_position()
///   coder          of the key-frames' poses; what Draco cannot hold is coded natively
///   leaf_faces     not 0: frames are rebuilt by MSGI, patches of that many faces; only for kRigid
/// The weights' step is chosen so that weights add about a third of the key-frames' own rounding
/// error. Nothing if the format cannot hold a number: the step is too fine for the clip.
std::optional<EncodedSegment> encode_keyframes(const FrameView& clip, const KeyframeFit& fit,
                                               KeyframeWeights kind,
                                               const Eigen::Vector3d& mean_position, double step,
                                               const MeshLayout& layout,
                                               KeyframePoses coder = KeyframePoses::kNative,
                                               uint32_t leaf_faces = 0);

/// The step for which rounding of key-frames and weights adds about `rms` (root mean square
/// distance, scene units) to every frame.
double step_for_rounding_error(const KeyframeFit& fit, double rms);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_KEYFRAME_SEGMENT_ENCODE_H_
