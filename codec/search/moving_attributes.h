// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_MOVING_ATTRIBUTES_H_
#define ANICODEC_CODEC_SEARCH_MOVING_ATTRIBUTES_H_

#include "codec/connectivity/attribute_encode.h"
#include "codec/plan/encode_result.h"
#include "codec/search/coded_segment.h"
#include "codec/search/encoder_input.h"

#include <memory>
#include <vector>

namespace anicodec {

/// Attributes that move, coded: how each came out, and the segments of all of them.
struct MovingAttributes {
  std::vector<AttributeResult> results;
  std::vector<CodedSegment> segments;
};

/// Codes how the values of attributes differ from those stored for frame 0, to the error that the options ask for:
/// three components at a time are trajectories of the attribute's entries, as positions are of coded vertices, over
/// the geometry of `pose` (null: one of their own). Elements of an entry move by the mean of what they do. Components
/// that stay within the error have no segment. Throws Error(kUsage) for an error that cannot be reached.
MovingAttributes encode_moving_attributes(const EncoderInput& input,
                                          const std::vector<StoredAttribute>& stored,
                                          const SearchOptions& options,
                                          std::shared_ptr<const EncodedPose> pose);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_MOVING_ATTRIBUTES_H_
