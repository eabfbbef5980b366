// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_RESIDUAL_READER_H_
#define ANICODEC_SDK_SEGMENT_RESIDUAL_READER_H_

#include "format/memory.h"
#include "format/status.h"
#include "sdk/prediction/vertex_order.h"
#include "sdk/segment/linear_segment.h"
#include "sdk/segment/segment.h"

#include <cstdint>

namespace anicodec {

/// Reads the residuals of a linear segment's coefficients from its layers, as components x channels x
/// vertices in decoding order; stops after `wanted` of the segment's components. Errors: those of
/// the layers; kCancelled by the host.
Status read_residuals(const SegmentContext& context, const LinearParameters& parameters,
                      const VertexOrder& order, uint32_t channels, uint32_t components,
                      uint32_t wanted, Vector<int32_t>* residuals);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_RESIDUAL_READER_H_
