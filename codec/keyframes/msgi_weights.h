// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAMES_MSGI_WEIGHTS_H_
#define ANICODEC_CODEC_KEYFRAMES_MSGI_WEIGHTS_H_

#include "codec/keyframes/keyframe_fit.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace anicodec {

/// A fit by key-frames whose frames are rebuilt by multi-scale geometry interpolation.
struct MsgiFit {
  KeyframeFit fit;
  uint32_t leaf_faces = 8;  ///< Msgi::Options
};

/// Improves weights and rigid motions of a fit of kind KeyframeWeights::kRigid, which were found
/// for straight lines, by Gauss-Newton steps through the interpolation itself: the derivatives by
/// the key-frames of largest weight are taken numerically. Starts from the fit of the least error,
/// of at least one: the best fit for straight lines may leave out the poses between which others
/// lie. Errors in the result are those of MSGI between the exact key-frames. Key-frames keep their
/// unit weights. `triangles` are over the clip's vertices. Throws Error(kInput) when the mesh
/// cannot be interpolated. Steps start from those weights or from the times of the key-frames
/// before and after, whichever do better. Cost: 10 to 40 evaluations of Msgi per frame; the same
/// bits for any number of threads.
MsgiFit fit_msgi_weights(const FrameView& clip, std::span<const uint32_t> triangles,
                         std::span<const KeyframeFit> rigid_fits);

/// The best that MSGI may do for a clip: the root mean square error of up to 24 frames between `count`
/// key-frames, two at least, that are spread evenly, with weights by time and moved rigidly. Nothing
/// where the mesh cannot be interpolated. Cost: Msgi::init() and as many evaluations.
std::optional<double> msgi_error_between(const FrameView& clip, std::span<const uint32_t> triangles,
                                         size_t count);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAMES_MSGI_WEIGHTS_H_
