// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_EXACT_EXACT_POSITIONS_H_
#define ANICODEC_SDK_EXACT_EXACT_POSITIONS_H_

#include "format/bytes.h"
#include "format/records.h"
#include "format/status.h"
#include "sdk/segment/segment.h"

#include <cstdint>

namespace anicodec {

/// A coordinate takes about as long to decode as so many coefficients.
inline constexpr uint32_t kExactWork = 2;

/// Decodes the payload of a chunk DIFF to the exact positions of an opened segment. Errors: the
/// file's; kCancelled by the host; kFeature in builds without.
Status open_exact_positions(ByteView payload, const SegmentContext& context, Segment* segment);

}  // namespace anicodec

#endif  // ANICODEC_SDK_EXACT_EXACT_POSITIONS_H_
