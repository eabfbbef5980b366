// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_LINEAR_SEGMENT_ENCODE_H_
#define ANICODEC_CODEC_SEGMENT_LINEAR_SEGMENT_ENCODE_H_

#include "codec/segment/encoded_segment.h"
#include "codec/segment/linear_basis.h"
#include "codec/segment/linear_settings.h"
#include "sdk/segment/linear_segment.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace anicodec {

/// Components of a basis, of each of its regions, that are worth coding at these settings.
std::vector<size_t> component_counts(const LinearBasis& basis, const LinearSettings& settings,
                                     size_t vertices, size_t frames);

/// The step that the pose of a basis is best coded with.
double pose_step(const LinearSettings& settings, size_t frames);

/// Quantises and codes a basis as a segment: time weights, the basis refitted to the decoded
/// weights (closed loop), its coefficients predicted and rounded with their cost in mind.
/// `runs`: how many frames each clip has that the frames are of; empty: they are of one.
/// `pose`: that of the basis, coded with pose_step() or as the file has it already.
/// Nothing if the format cannot hold a number: the step is too fine for the clip.
/// Cost: O(vertices x components x neighbours^2), two passes over the clip.
std::optional<EncodedSegment> encode_linear(const FrameView& clip, const LinearBasis& basis,
                                            const LinearSettings& settings,
                                            const MeshLayout& layout,
                                            std::shared_ptr<const EncodedPose> pose,
                                            const Vector<uint32_t>& runs = {},
                                            const Learning& learning = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_LINEAR_SEGMENT_ENCODE_H_
