// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/basis_layer.h"

#include <utility>

namespace anicodec {
namespace {

Status read(ByteView chunk, uint32_t most, BasisLayer* out) {
  ByteReader r(chunk);
  out->count = r.varint32(most);
  out->weights = r.block();
  out->coefficients = r.raw(r.remaining());
  return r.ok() ? Status::kOk : Status::kRecord;
}

}  // namespace

Bytes BasisLayer::write() const {
  ByteWriter w;
  w.varint(count);
  w.block(weights);
  w.raw(coefficients);
  return std::move(w.bytes());
}

Status read_layers(const Vector<ByteView>& chunks, uint32_t components, uint32_t wanted,
                   Vector<BasisLayer>* out) {
  uint32_t first = 0;
  for (ByteView chunk : chunks) {
    if (first >= wanted)
      break;
    BasisLayer layer;
    layer.first = first;
    if (Status s = read(chunk, components - first, &layer); s != Status::kOk)
      return s;
    first += layer.count;
    out->push_back(layer);
  }
  return first >= wanted ? Status::kOk : Status::kChunkMissing;
}

}  // namespace anicodec
