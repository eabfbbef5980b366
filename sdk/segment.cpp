// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment.h"

#include "format/checksum.h"
#include "sdk/bounded_float.h"
#include "sdk/correction_coding.h"
#include "sdk/float_control.h"
#include "sdk/keyframe_segment.h"
#include "sdk/linear_segment.h"
#include "sdk/residency.h"

#include <cmath>

namespace anicodec {

ResidentWriter::ResidentWriter(Segment* segment) : segment_(*segment) {
  size_t per_component = size_t{block_count(segment->vertices)} * segment->channels() * kBlock;
  segment->wide.assign(per_component * segment->wide_components, 0);
  segment->narrow.assign(per_component * (segment->components - segment->wide_components), 0);
}

bool ResidentWriter::store(uint32_t component, const int32_t* values, uint32_t channels) {
  bool wide = component < segment_.wide_components;
  uint32_t count = wide ? segment_.wide_components : segment_.components - segment_.wide_components;
  uint32_t row = wide ? component : component - segment_.wide_components;
  for (uint32_t v = 0; v < segment_.vertices; ++v) {
    for (uint32_t c = 0; c < channels; ++c) {
      int32_t x = *values++;
      size_t at = ((size_t{v / kBlock} * count + row) * channels + c) * kBlock + v % kBlock;
      if (wide) {
        segment_.wide[at] = x;
      } else {
        if (x != static_cast<int16_t>(x))
          return false;
        segment_.narrow[at] = static_cast<int16_t>(x);
      }
    }
  }
  return true;
}

namespace {

Status read_corrections(format::ByteView bytes, uint32_t total, format::IntegerHash& hash,
                        Segment* out) {
  if (bytes.size == 0)
    return total == 0 ? Status::kOk : Status::kChunkMissing;
  format::ByteReader reader(bytes);
  double step = reader.f64();
  if (!reader.ok() || !std::isfinite(step) || step <= 0)
    return Status::kQuantizer;
  format::ByteView stream = reader.raw(reader.remaining());
  BinaryDecoder decoder(stream.data, stream.size);
  CorrectionCoding coding(out->vertices);
  std::vector<IntegerCorrection> frame;
  out->correction_begin.assign(1, 0);
  for (uint32_t f = 0; f < out->frames; ++f) {
    if (!coding.code_frame(decoder, total - out->corrections.size(), &frame))
      return Status::kEntropy;
    for (const IntegerCorrection& c : frame) {
      Segment::Correction& correction = out->corrections.emplace_back();
      correction.vertex = c.vertex;
      for (size_t i = 0; i < 3; ++i) {
        if (!to_float(c.delta[i] * step, &correction.delta[i]))
          return Status::kNonFinite;
      }
      const int32_t hashed[5] = {static_cast<int32_t>(f), static_cast<int32_t>(c.vertex),
                                 c.delta[0], c.delta[1], c.delta[2]};
      hash.add(hashed, 5);
    }
    out->correction_begin.push_back(static_cast<uint32_t>(out->corrections.size()));
  }
  return decoder.finish() && out->corrections.size() == total ? Status::kOk : Status::kEntropy;
}

}  // namespace

Status open_segment(const format::SegmentRecord& record, const SegmentContext& context,
                    Segment* out) {
  const format::Limits::Segment& sizes = *context.sizes;
  out->kind = record.kind;
  out->reconstruction = record.reconstruction;
  out->mesh = sizes.mesh;
  out->first_frame = sizes.first_frame;
  out->frames = sizes.frames;
  out->vertices = context.topology->coded_vertices;
  out->components = sizes.components;
  out->wide_components = sizes.wide_components;
  out->stored_hash = record.hash;
  const FloatControl control;
  format::IntegerHash hash;
  Status status = record.kind == format::BasisKind::kKeyframes
                      ? open_keyframe_segment(record, context, hash, out)
                      : open_linear_segment(record, context, hash, out);
  if (status == Status::kOk)
    status = read_corrections(context.corrections, sizes.corrections, hash, out);
  out->decoded_hash = hash.digest();
  return status;
}

}  // namespace anicodec
