// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_CLIP_BOUNDS_H_
#define ANICODEC_CODEC_SEARCH_CLIP_BOUNDS_H_

#include "codec/search/encoder_input.h"
#include "codec/search/segment_search.h"

#include <cstdint>
#include <optional>

namespace anicodec {

/// Codes frames from `first` on so that every clip among them keeps its share of the error `rmse`
/// (InputClip::tolerance), the worst of them close to it. If no clip has a bound of its own, the
/// same as SegmentSearch::at_rmse(). Cost: a few searches of the step for each further one.
std::optional<CodedSegment> within_bounds(SegmentSearch& search, const EncoderInput& input,
                                          uint32_t first, double rmse);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_CLIP_BOUNDS_H_
