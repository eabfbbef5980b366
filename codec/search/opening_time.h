// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_OPENING_TIME_H_
#define ANICODEC_CODEC_SEARCH_OPENING_TIME_H_

#include "codec/segment/encoded_segment.h"
#include "codec/segment/linear_settings.h"

#include <cstddef>

namespace anicodec {

/// About the nanoseconds of one thread that a decoder spends on the time weights and coefficients of a
/// linear segment, the part of opening that settings change: reading both, by how many there are and what
/// coefficients take, and predicting these, by neighbours and refits. Made for ratios; machines differ.
double opening_nanoseconds(const LinearSettings& settings, const EncodedSegment& encoded,
                           size_t vertices);

/// Bytes that a nanosecond of opening is worth to a search, the multiplier of its Lagrangian: none if the
/// smallest file is wanted.
double bytes_per_nanosecond(bool smallest);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_OPENING_TIME_H_
