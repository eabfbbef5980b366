// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_RESIDUAL_READER_H_
#define ANICODEC_SDK_SEGMENT_RESIDUAL_READER_H_

#include "format/coding/coefficient_model.h"
#include "format/memory.h"
#include "format/status.h"
#include "sdk/prediction/vertex_order.h"
#include "sdk/segment/basis_layer.h"
#include "sdk/segment/segment.h"

#include <cstdint>
#include <optional>

namespace anicodec {

/// Room for residuals, components x channels x vertices in decoding order: those of the first components
/// have 32 bits, of the others 16.
struct ResidualRoom {
  uint32_t wide_components = 0;
  int32_t* wide = nullptr;
  int16_t* narrow = nullptr;
};

/// Reads the residuals of a linear segment's coefficients from its layers; stops after `wanted` of the
/// segment's components. `model`: with which it begins, none: anew; with which it ends. layers_anew: see LinearParameters. Errors: those of the layers;
/// kEntropy: one does not fit its room; kCancelled by the host.
Status read_residuals(const SegmentContext& context, bool layers_anew, const VertexOrder& order,
                      uint32_t channels, const Vector<BasisLayer>& layers, uint32_t wanted,
                      const ResidualRoom& room, std::optional<CoefficientModel>* model);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_RESIDUAL_READER_H_
