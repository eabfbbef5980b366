// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_MOTION_ERROR_H_
#define ANICODEC_CODEC_SEARCH_MOTION_ERROR_H_

#include "codec/search/coded_segment.h"
#include "codec/search/encoder_input.h"
#include "format/records.h"

#include <vector>

namespace anicodec {

/// Comparison::max_displacement_error (kDisplacement) or the STED (kSted) of what the segments show, all
/// frames of the input in order: that of the worst clip by its share of the bound (InputClip::tolerance). Cost: one
/// pass, ten times that for the STED.
double motion_error(ErrorMetric metric, const std::vector<CodedSegment>& segments,
                    const EncoderInput& input);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_MOTION_ERROR_H_
