// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/exact/exact_positions.h"

#include "format/checksum.h"
#include "sdk/base/float_control.h"
#include "sdk/exact/exact_coding.h"

#include <cstring>

namespace anicodec {
namespace {

constexpr uint32_t kShown = 1024;  // integers that are hashed and shown at a time

/// Hashes the bits of a frame, and shows them.
void hash_frame(const float* frame, size_t count, DecodingTrace* trace, IntegerHash* hash) {
  int32_t bits[kShown];
  for (size_t begin = 0; begin < count; begin += kShown) {
    const size_t n = std::min<size_t>(kShown, count - begin);
    std::memcpy(bits, frame + begin, n * sizeof(float));
    hash->add(bits, n);
    if (kTraces && trace)
      trace->step("exact positions", bits, n);
  }
}

}  // namespace

Status open_exact_positions(ByteView payload, const SegmentContext& context, Segment* segment) {
  const uint32_t vertices = context.topology->coded_vertices;
  ExactRecord record;
  if (Status s = ExactRecord::read(payload, *context.sizes, *context.mesh_sizes, &record);
      s != Status::kOk)
    return s;
  const FloatControl control;
  const size_t frame = size_t{3} * vertices;
  segment->exact.resize(frame * segment->frames);
  BinaryDecoder decoder(record.stream.data, record.stream.size);
  const EarlierNeighbours neighbours(*context.topology);
  ExactCoding coding(record, neighbours, vertices);
  IntegerHash hash;
  for (uint32_t f = 0; f < segment->frames; ++f) {
    if (!coding.code_frame(decoder, f, 0, segment->exact.data()))
      return Status::kEntropy;
    hash_frame(segment->exact.data() + frame * f, frame, context.trace, &hash);
    if (!context.advance(kExactWork * frame))
      return Status::kCancelled;
  }
  if (!decoder.finish())
    return Status::kEntropy;
  segment->stored_exact_hash = record.hash;
  segment->decoded_exact_hash = hash.digest();
  if (context.vertex_coded)
    segment->vertex_coded = *context.vertex_coded;
  return Status::kOk;
}

}  // namespace anicodec
