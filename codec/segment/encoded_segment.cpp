// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/encoded_segment.h"

#include "codec/parallel/parallel.h"
#include "codec/segment/segment_player.h"
#include "codec/sequence/error.h"
#include "format/status.h"
#include "sdk/segment/correction_coding.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace anicodec {
namespace {

/// Calls visit(f, positions of frame f as decoded) for all frames, in parallel over fixed ranges.
template <class Visit>
void for_each_frame(const Segment& segment, Visit visit) {
  constexpr uint32_t kFrames = 8;
  uint32_t tasks = (segment.frames + kFrames - 1) / kFrames;
  parallel_for(uint32_t{0}, tasks, [&](uint32_t task) {
    SegmentPlayer player;
    for (uint32_t f = task * kFrames; f < std::min(segment.frames, (task + 1) * kFrames); ++f)
      visit(f, player.play(segment, f));
  });
}

double squared_distance(const float* a, const float* b) {
  double s = 0;
  for (size_t c = 0; c < 3; ++c) {
    double d = static_cast<double>(a[c]) - static_cast<double>(b[c]);
    s += d * d;
  }
  return s;
}

/// Squared distance of a decoded vertex from the source once it is corrected.
double error_of(const IntegerCorrection& c, const float* decoded, const float* original,
                double step) {
  float corrected[3];
  for (size_t i = 0; i < 3; ++i)
    corrected[i] = decoded[i] + static_cast<float>(c.delta[i] * step);
  return squared_distance(corrected, original);
}

/// In multiples of `unit` steps.
IntegerCorrection nearest_correction(const float* decoded, const float* original, double step,
                                     int32_t unit) {
  IntegerCorrection c;
  for (size_t i = 0; i < 3; ++i) {
    const double steps = std::round(
        (static_cast<double>(original[i]) - static_cast<double>(decoded[i])) / (step * unit));
    c.delta[i] = static_cast<int32_t>(std::clamp(steps * unit, -1e9, 1e9));
  }
  return c;
}

/// Makes numbers of a correction smaller by `unit` as long as the vertex stays within `bound`, that first
/// which costs the least error: fewer bits.
void shorten(const float* decoded, const float* original, double step, int32_t unit, double bound,
             IntegerCorrection& c) {
  for (;;) {
    IntegerCorrection best = c;
    double least = bound * bound;
    for (size_t i = 0; i < 3; ++i) {
      if (c.delta[i] == 0)
        continue;
      IntegerCorrection shorter = c;
      shorter.delta[i] -= c.delta[i] > 0 ? unit : -unit;
      const double error = error_of(shorter, decoded, original, step);
      if (error <= least) {
        least = error;
        best = shorter;
      }
    }
    if (std::equal(best.delta, best.delta + 3, c.delta))
      return;
    c = best;
  }
}

}  // namespace

size_t EncodedSegment::bytes() const {
  size_t total = parameters.size() + pose.size() + motion.size() + weights.size() +
                 corrections.size() + exact.size();
  for (const Bytes& layer : layers)
    total += layer.size();
  return total;
}

Segment open_encoded(EncodedSegment& encoded, const MeshLayout& layout) {
  SegmentRecord record;
  record.parameters = encoded.parameters;
  record.pose = encoded.pose;
  record.motion = encoded.motion;
  record.weights = encoded.weights;
  SegmentContext context;
  context.sizes = &encoded.sizes;
  context.mesh_sizes = &layout.sizes;
  context.topology = &layout.topology;
  context.pose = encoded.reference ? &encoded.reference->grid : nullptr;
  context.layers.assign(encoded.layers.begin(), encoded.layers.end());
  context.corrections = encoded.corrections;
  context.runs = encoded.runs;
  context.continued = encoded.continued;
  context.decoded = encoded.decoded ? &*encoded.decoded : nullptr;
  Segment segment;
  Status status = open_segment(record, context, &segment);
  encoded.decoded.reset();
  if (status == Status::kNonFinite)
    throw Error(ErrorKind::kInput, "the coordinates are too large");
  if (status == Status::kLimit)
    throw Error(ErrorKind::kUsage,
                "geometry interpolation of this mesh takes more memory than decoders allow");
  if (status != Status::kOk)
    throw Error(ErrorKind::kInternal,
                std::string("the encoded segment cannot be opened: ") + status_string(status));
  encoded.hash = segment.stored_hash = segment.decoded_hash;
  return segment;
}

SegmentError measure(const Segment& segment, const FrameView& source,
                     const std::vector<uint32_t>& copies) {
  std::vector<double> squared(segment.frames), largest(segment.frames);
  for_each_frame(segment, [&](uint32_t f, const float* decoded) {
    const float* original = source.frame(f);
    double sum = 0, most = 0;
    for (size_t v = 0; v < segment.vertices; ++v) {
      const double d = squared_distance(decoded + 3 * v, original + 3 * v);
      sum += copies[v] * d;
      most = std::max(most, d);
    }
    squared[f] = sum;
    largest[f] = most;
  });
  const double sum = std::accumulate(squared.begin(), squared.end(), 0.0);
  return {sum, std::sqrt(*std::max_element(largest.begin(), largest.end())), std::move(squared)};
}

void correct(const FrameView& source, const std::vector<uint32_t>& copies,
             const std::vector<double>& bounds, Segment& segment, EncodedSegment& encoded) {
  // Rounding to a cubic grid leaves at most half its diagonal: 0.95 of the bound, the rest is for
  // float32.
  const double least = *std::ranges::min_element(bounds), step = 1.9 * least / std::sqrt(3.0);
  segment.correction_begin.clear();
  segment.corrections.clear();
  std::vector<Vector<IntegerCorrection>> frames(segment.frames);
  std::vector<uint8_t> too_fine(segment.frames, 0);
  for_each_frame(segment, [&](uint32_t f, const float* decoded) {
    const float* original = source.frame(f);
    const double bound = bounds[f];
    const auto unit = static_cast<int32_t>(std::min(bound / least, 0x1p24));
    for (uint32_t v = 0; v < segment.vertices; ++v) {
      const float *d = decoded + size_t{3} * v, *o = original + size_t{3} * v;
      if (squared_distance(d, o) <= bound * bound)
        continue;
      IntegerCorrection& c = frames[f].emplace_back(nearest_correction(d, o, step, unit));
      c.vertex = v;
      too_fine[f] |= error_of(c, d, o, step) > bound * bound;
      shorten(d, o, step, unit, 0.98 * bound, c);
    }
  });
  if (std::find(too_fine.begin(), too_fine.end(), 1) != too_fine.end())
    throw Error(ErrorKind::kUsage, "the error bound is finer than float32 positions can keep");

  CorrectionCoding coding(segment.vertices);
  BinaryEncoder encoder;
  size_t total = 0;
  for (Vector<IntegerCorrection>& frame : frames) {
    for (const IntegerCorrection& c : frame)
      total += copies[c.vertex];
    coding.code_frame(encoder, frame.size(), &frame);
  }
  encoded.sizes.corrections = static_cast<uint32_t>(total);
  encoded.corrections.clear();
  if (total == 0)
    return;
  ByteWriter writer;
  writer.f64(step);
  writer.raw(encoder.finish());
  encoded.corrections = std::move(writer.bytes());
  segment.correction_begin.assign(1, 0);
  for (const Vector<IntegerCorrection>& frame : frames) {
    for (const IntegerCorrection& c : frame) {
      Segment::Correction& correction = segment.corrections.emplace_back();
      correction.vertex = c.vertex;
      for (size_t i = 0; i < 3; ++i)
        correction.delta[i] = static_cast<float>(c.delta[i] * step);
    }
    segment.correction_begin.push_back(static_cast<uint32_t>(segment.corrections.size()));
  }
}

}  // namespace anicodec
