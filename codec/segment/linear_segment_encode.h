// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_LINEAR_SEGMENT_ENCODE_H_
#define ANICODEC_CODEC_SEGMENT_LINEAR_SEGMENT_ENCODE_H_

#include "codec/segment/encoded_segment.h"
#include "codec/segment/linear_basis.h"
#include "sdk/segment/linear_segment.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace anicodec {

/// How finely a linear basis is coded, all steps tied to that of the coefficients.
struct LinearSettings {
  double step = 1;             ///< of the coefficients, scene units
  double weight_factor = 2.4;  ///< step of time weights: weight_factor * step / sigma
  double pose_factor = 2;      ///< step of the pose: pose_factor * step / sqrt(frames)
  double lambda = 0.08;        ///< squared steps that a bit is worth when rounding coefficients
  double weight_lambda = 0.1;  ///< the same for time weights
  double rank_factor =
      0.2;  ///< components with less energy per scalar, in squared steps, are left out
  size_t components = 0;  ///< exact number of components; 0: as many as rank_factor says
  uint8_t neighbours = 16;
  uint8_t passes_per_level = 1;
  uint8_t radius = 12;
  RefitSchedule schedule = RefitSchedule::kDense;
  uint32_t layers = 1;  ///< parts that the components are stored in
};

/// Components of a basis that are worth coding at these settings.
size_t component_count(const LinearBasis& basis, const LinearSettings& settings, size_t vertices,
                       size_t frames);

/// Quantises and codes a basis as a segment: pose, time weights, the basis refitted to the decoded
/// weights (closed loop), its coefficients predicted and rounded with their cost in mind.
/// `shared`: a pose that the file has already, from which the basis was made; null: the basis' own.
/// Nothing if the format cannot hold a number: the step is too fine for the clip.
/// Cost: O(vertices x components x neighbours^2), two passes over the clip.
std::optional<EncodedSegment> encode_linear(const FrameView& clip, const LinearBasis& basis,
                             const LinearSettings& settings, const MeshLayout& layout,
                             std::shared_ptr<const EncodedPose> shared = nullptr);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_LINEAR_SEGMENT_ENCODE_H_
