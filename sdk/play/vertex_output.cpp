// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/vertex_output.h"

#include <cmath>

namespace anicodec {

bool is_valid(const VertexOutput& output) {
  if (static_cast<uint32_t>(output.format) >= kVertexFormatCount ||
      output.stride < vertex_format_size(output.format))
    return false;
  for (size_t c = 0; c < 3; ++c) {
    if (!std::isfinite(output.offset[c]) || !std::isnormal(output.scale[c]) ||
        !std::isnormal(65535 / output.scale[c]))
      return false;
  }
  return true;
}

}  // namespace anicodec
