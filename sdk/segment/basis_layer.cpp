// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/basis_layer.h"

#include <utility>

namespace anicodec {
namespace {

Status read(ByteView chunk, uint32_t slice_count, uint32_t most, BasisLayer* out) {
  ByteReader r(chunk);
  out->count = r.varint32(most);
  const uint64_t weights = r.varint();
  uint64_t sizes[kMostSlices];
  for (uint32_t s = 0; s + 1 < slice_count; ++s)
    sizes[s] = r.varint();
  out->weights = r.raw(weights);
  for (uint32_t s = 0; s + 1 < slice_count; ++s)
    out->slices[s] = r.raw(sizes[s]);
  out->slices[slice_count - 1] = r.raw(r.remaining());
  return r.ok() ? Status::kOk : Status::kRecord;
}

}  // namespace

Bytes BasisLayer::write(uint32_t slice_count) const {
  ByteWriter w;
  w.varint(count);
  w.varint(weights.size);
  for (uint32_t s = 0; s + 1 < slice_count; ++s)
    w.varint(slices[s].size);
  w.raw(weights);
  for (uint32_t s = 0; s < slice_count; ++s)
    w.raw(slices[s]);
  return std::move(w.bytes());
}

Status read_layers(const Vector<ByteView>& chunks, uint32_t slice_count, uint32_t components,
                   uint32_t wanted, Vector<BasisLayer>* out) {
  uint32_t first = 0;
  for (ByteView chunk : chunks) {
    if (first >= wanted)
      break;
    BasisLayer layer;
    layer.first = first;
    if (Status s = read(chunk, slice_count, components - first, &layer); s != Status::kOk)
      return s;
    first += layer.count;
    out->push_back(layer);
  }
  return first >= wanted ? Status::kOk : Status::kChunkMissing;
}

}  // namespace anicodec
