// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/segment.h"

#include "format/sort.h"
#include "sdk/base/bounded_float.h"
#include "sdk/base/float_control.h"
#include "sdk/segment/correction_coding.h"
#include "sdk/segment/keyframe_segment.h"
#include "sdk/segment/linear_segment.h"

#include <algorithm>
#include <cmath>

namespace anicodec {

namespace {

/// The vertices of each coded vertex v: vertices[begin[v]] .. vertices[begin[v + 1] - 1],
/// ascending.
struct Copies {
  Copies(const Vector<uint32_t>& vertex_coded, uint32_t coded_vertices)
      : begin(size_t{coded_vertices} + 1, 0), vertices(vertex_coded.size()) {
    for (uint32_t c : vertex_coded)
      ++begin[c + 1];
    for (size_t c = 0; c < coded_vertices; ++c)
      begin[c + 1] += begin[c];
    Vector<uint32_t> next(begin.begin(), begin.end() - 1);
    for (uint32_t v = 0; v < vertex_coded.size(); ++v)
      vertices[next[vertex_coded[v]]++] = v;
  }

  uint32_t count(uint32_t coded) const { return begin[coded + 1] - begin[coded]; }

  Vector<uint32_t> begin, vertices;
};

Status read_corrections(const SegmentContext& context, DecodedIntegers& integers, Segment* out) {
  const uint32_t total = context.sizes->corrections;
  if (context.corrections.size == 0)
    return total == 0 || context.partial ? Status::kOk : Status::kChunkMissing;
  ByteReader reader(context.corrections);
  double step = reader.f64();
  if (!reader.ok() || !std::isfinite(step) || step <= 0)
    return Status::kQuantizer;
  ByteView stream = reader.raw(reader.remaining());
  BinaryDecoder decoder(stream.data, stream.size);
  const uint32_t coded_vertices = context.topology->coded_vertices;
  const Copies copies(context.topology->vertex_coded, coded_vertices);
  CorrectionCoding coding(coded_vertices);
  Vector<IntegerCorrection> frame;
  uint64_t corrected = 0;  // vertices, over the frames
  out->corrections.reserve(total);
  out->correction_begin.reserve(size_t{out->frames} + 1);
  out->correction_begin.push_back(0);
  for (uint32_t f = 0; f < out->frames; ++f) {
    if (!coding.code_frame(decoder, static_cast<size_t>(total - corrected), &frame))
      return Status::kEntropy;
    for (const IntegerCorrection& c : frame) {
      corrected += copies.count(c.vertex);
      if (corrected > total)
        return Status::kEntropy;
      Segment::Correction correction;
      correction.vertex = c.vertex;
      for (size_t i = 0; i < 3; ++i) {
        if (!to_float(c.delta[i] * step, &correction.delta[i]))
          return Status::kNonFinite;
      }
      if (!context.vertex_coded)
        out->corrections.push_back(correction);
      for (uint32_t i = 0; context.vertex_coded && i < copies.count(c.vertex); ++i) {
        correction.vertex = copies.vertices[copies.begin[c.vertex] + i];
        out->corrections.push_back(correction);
      }
      const int32_t hashed[5] = {static_cast<int32_t>(f), static_cast<int32_t>(c.vertex),
                                 c.delta[0], c.delta[1], c.delta[2]};
      integers.add("correction", hashed, 5);
    }
    sort_ascending(out->corrections.data() + out->correction_begin.back(),
                   out->corrections.data() + out->corrections.size(),
                   [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    out->correction_begin.push_back(static_cast<uint32_t>(out->corrections.size()));
  }
  return decoder.finish() && corrected == total ? Status::kOk : Status::kEntropy;
}

}  // namespace

uint32_t wanted_components(double quality, uint32_t components) {
  return std::min(static_cast<uint32_t>(std::ceil(quality * components)), components);
}

double segment_work(const Limits::Segment& segment, const Limits::Mesh& mesh, double quality) {
  const bool keyframes = segment.kind == BasisKind::kKeyframes;
  const uint32_t components =
      keyframes ? segment.components : wanted_components(quality, segment.components);
  const double coefficients =
      static_cast<double>(mesh.coded_vertices) * components * traits_of(segment.kind).channels;
  return keyframes ? coefficients : 2 * coefficients;  // read, then predicted
}

Status open_segment(const SegmentRecord& record, const SegmentContext& context, Segment* out) {
  const Limits::Segment& sizes = *context.sizes;
  out->kind = sizes.kind;
  out->reconstruction = sizes.reconstruction;
  out->mesh = sizes.mesh;
  out->first_frame = sizes.first_frame;
  out->frames = sizes.frames;
  out->vertices = context.vertex_coded ? static_cast<uint32_t>(context.vertex_coded->size())
                                       : context.topology->coded_vertices;
  out->components = sizes.components;
  out->wide_components = sizes.wide_components;
  out->regions = sizes.regions;
  out->stored_hash = record.hash;
  const FloatControl control;
  DecodedIntegers integers(context.trace);
  Status status = sizes.kind == BasisKind::kKeyframes
                      ? open_keyframe_segment(record, context, integers, out)
                      : open_linear_segment(record, context, integers, out);
  if (status == Status::kOk)
    status = read_corrections(context, integers, out);
  out->decoded_hash = integers.digest();
  return status;
}

size_t Segment::resident_bytes() const {
  auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
  return bytes(pose) + bytes(vertex_region) + bytes(wide) + bytes(narrow) + bytes(weights) +
         bytes(pose_maps) + bytes(motions) + bytes(correction_begin) + bytes(corrections) +
         bytes(vertex_coded) + bytes(exact) + (msgi.empty() ? 0 : msgi[0].resident_bytes());
}

}  // namespace anicodec
