// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/residual_reader.h"

#include "format/coding/rans_coder.h"

#include <algorithm>

namespace anicodec {

Status read_residuals(const SegmentContext& context, bool layers_anew, const VertexOrder& order,
                      uint32_t channels, const Vector<BasisLayer>& layers, uint32_t wanted,
                      const ResidualRoom& room, std::optional<CoefficientModel>* model) {
  const size_t of_component = size_t{channels} * order.vertex_count();
  for (const BasisLayer& layer : layers) {
    if (layer.count == 0)
      continue;
    if (!*model || (layers_anew && layer.first > 0))
      model->emplace(channels, order.neighbours.data(),
                     static_cast<uint32_t>(order.neighbour_count), order.level_start);
    RansDecoder decoder(layer.coefficients);
    const uint32_t end = std::min(layer.first + layer.count, wanted);
    for (uint32_t j = layer.first; j < end; ++j) {
      if (j < room.wide_components)
        (*model)->code_component(decoder, room.wide + j * of_component);
      else
        (*model)->code_component(decoder, room.narrow + (j - room.wide_components) * of_component);
      if (!decoder.ok())
        return Status::kEntropy;
      if (!context.advance(of_component))
        return Status::kCancelled;
    }
    if (end == layer.first + layer.count && !decoder.finish())
      return Status::kEntropy;
  }
  return Status::kOk;
}

}  // namespace anicodec
