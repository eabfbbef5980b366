// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_BASIS_LAYER_H_
#define ANICODEC_SDK_SEGMENT_BASIS_LAYER_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

/// Some components of a linear basis, one after the other: a chunk BASI (spec/06-chunks.md, section
/// 8). Views of the chunk.
struct BasisLayer {
  uint32_t first = 0, count = 0;  ///< components
  ByteView weights, coefficients;

  Bytes write() const;
};

/// The layers as far as `wanted` of the segment's components. Errors: kRecord, kChunkMissing: too few
/// components.
Status read_layers(const Vector<ByteView>& chunks, uint32_t components, uint32_t wanted,
                   Vector<BasisLayer>* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_BASIS_LAYER_H_
