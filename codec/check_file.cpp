// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/check_file.h"

#include "codec/parallel/task_threads.h"
#include "codec/sequence/error.h"
#include "sdk/clip/clip.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>
#include <string>

namespace anicodec {
namespace {

Clip opened(const Bytes& file, KeptLearning* learning) {
  Clip clip;
  OpenOptions options;
  options.threads = task_threads();
  options.learning = learning;
  if (Failure failure = clip.open(file, options); !failure.ok())
    throw Error(ErrorKind::kInternal,
                std::string("the encoded file cannot be opened: ") + status_string(failure.status));
  if (Failure failure = clip.check_hashes(); !failure.ok())
    throw Error(ErrorKind::kInternal, "the encoded file decodes to other integers");
  return clip;
}

/// For each vertex of the source, the played vertex that shows it.
std::vector<uint32_t> played_vertices(const Clip& clip, const MeshLayout& layout) {
  std::vector<uint32_t> played(layout.source_coded.size());
  if (clip.record().order != OrderMode::kFree) {
    std::iota(played.begin(), played.end(), 0U);
    return played;
  }
  const Vector<uint32_t>& coded = clip.meshes()[0].topology.vertex_coded;
  std::vector<uint32_t> played_of_coded(layout.sizes.coded_vertices);
  for (uint32_t v = 0; v < coded.size(); ++v)
    played_of_coded[coded[v]] = v;
  for (uint32_t v = 0; v < played.size(); ++v)
    played[v] = played_of_coded[layout.source_coded[v]];
  return played;
}

/// Copies rows of three numbers: row rows[v] of `from` to row v.
void copy_rows(const float* from, const std::vector<uint32_t>& rows, std::vector<float>* to) {
  to->resize(3 * rows.size());
  for (size_t v = 0; v < rows.size(); ++v)
    std::copy_n(from + size_t{3} * rows[v], 3, to->data() + 3 * v);
}

/// In the source's vertex order whatever the file's.
Comparison compare_positions(const Clip& clip, const EncoderInput& input, const FrameRun& run) {
  const std::vector<uint32_t> played_of = played_vertices(clip, input.layout);
  const uint32_t vertices = input.sequence.vertex_count;
  std::vector<float> original, decoded, played(size_t{3} * vertices);
  CompareOptions options;
  options.sted = false;
  return compare(
      input.sequence.polygons, vertices, run.count,
      [&](uint32_t f) -> std::span<const float> {
        copy_rows(input.shown().frame(run.first + f), input.layout.source_coded, &original);
        return original;
      },
      [&](uint32_t f) -> std::span<const float> {
        clip.positions(0, run.first + f, played.data());
        copy_rows(played.data(), played_of, &decoded);
        return decoded;
      },
      options);
}

/// Whether a clip without error has the bits of the source, too: zeros with their signs.
bool has_all_bits(const Clip& clip, const EncoderInput& input, const FrameRun& run) {
  const std::vector<uint32_t> played_of = played_vertices(clip, input.layout);
  std::vector<float> original, decoded, played(size_t{3} * input.sequence.vertex_count);
  for (uint32_t f = run.first; f < run.first + run.count; ++f) {
    copy_rows(input.shown().frame(f), input.layout.source_coded, &original);
    clip.positions(0, f, played.data());
    copy_rows(played.data(), played_of, &decoded);
    if (std::memcmp(original.data(), decoded.data(), original.size() * sizeof(float)) != 0)
      return false;
  }
  return true;
}

/// Measures one attribute that changes over time in some frames.
AttributeError measure(const Clip& clip, const EncoderInput& input, const FrameRun& run,
                       const StoredAttribute& stored, uint32_t first_frame) {
  const Attribute& attribute = input.sequence.attributes[stored.source];
  AttributeError error;
  error.attribute = static_cast<uint16_t>(stored.number);
  const OrderMode order = clip.record().order;
  const bool canonical =
      order == OrderMode::kFree || (order == OrderMode::kVertices && !attribute.per_vertex());
  const size_t elements = stored.rows.size(), n = attribute.components;
  std::vector<float> played(elements * n);
  double squared = 0;
  for (uint32_t f = run.first; f < run.first + run.count; ++f) {
    clip.attribute_values(0, stored.number, f, played.data());
    const float* source = attribute.values.data() + size_t{f + first_frame} * elements * n;
    for (size_t e = 0; e < elements; ++e) {
      const float* values = source + (canonical ? stored.rows[e] : e) * n;
      for (size_t c = 0; c < n; ++c) {
        const double d = static_cast<double>(values[c]) - static_cast<double>(played[e * n + c]);
        squared += d * d;
        error.max_error = std::max(error.max_error, std::abs(d));
      }
    }
  }
  error.rmse = std::sqrt(squared / static_cast<double>(n * elements) / run.count);
  return error;
}

/// A box around points, moved outwards by what decoders may differ by.
Box box_of(const std::vector<float>& points) {
  Box box;
  for (size_t c = 0; c < 3; ++c) {
    box.low[c] = box.high[c] = points[c];
    for (size_t i = c; i < points.size(); i += 3) {
      box.low[c] = std::min(box.low[c], points[i]);
      box.high[c] = std::max(box.high[c], points[i]);
    }
  }
  return box;
}

/// Boxes of the frames of a segment as it plays, with a margin for decoders that round in another way.
BoundsRecord bounds_of(const Clip& clip, uint32_t number) {
  BoundsRecord bounds;
  const Limits::Segment& segment = clip.limits().segments[number];
  if (segment.attribute != kPositions)
    return bounds;
  constexpr float kMargin = 1.0F / (1 << 14);
  std::vector<float> played(size_t{3} * clip.limits().meshes[segment.mesh].source_vertices);
  Vector<Box> boxes;
  for (uint32_t f = segment.first_frame; f < segment.first_frame + segment.frames; ++f) {
    clip.positions(segment.mesh, f, played.data());
    Box box = box_of(played);
    float size = 0;
    for (size_t c = 0; c < 3; ++c)
      size = std::max(
          {size, box.high[c] - box.low[c], std::abs(box.low[c]) / 16, std::abs(box.high[c]) / 16});
    for (size_t c = 0; c < 3; ++c) {
      box.low[c] -= size * kMargin;
      box.high[c] += size * kMargin;
    }
    boxes.push_back(box);
  }
  bounds.set(boxes, kFramesOfBox);
  return bounds;
}

}  // namespace

CheckedFile check_file(const Bytes& file, const EncoderInput& input,
                       const std::vector<StoredAttribute>& stored, uint32_t first_frame,
                       KeptLearning* learning, std::vector<AttributeResult>* attributes) {
  const Clip clip = opened(file, learning);
  CheckedFile checked;
  std::vector<MeasuredClip>& clips = checked.clips;
  for (const InputClip& source : input.clips) {
    MeasuredClip& measured = clips.emplace_back();
    measured.positions = compare_positions(clip, input, source.frames);
    if (clip.limits().segments[clip.by_frame()[0]].exact &&
        !has_all_bits(clip, input, source.frames))
      throw Error(ErrorKind::kInternal, "the encoded file does not have the source's positions");
    for (AttributeResult& result : *attributes) {
      const auto of = std::ranges::find(stored, result.number, &StoredAttribute::number);
      const AttributeError error = measure(clip, input, source.frames, *of, first_frame);
      if (error.max_error > result.asked)
        throw Error(ErrorKind::kInternal, result.name + ": the error is above what was asked for");
      result.max_error = std::max(result.max_error, error.max_error);
      result.rmse = std::hypot(
          result.rmse,
          error.rmse * std::sqrt(static_cast<double>(source.frames.count) / clip.frame_count()));
      measured.attributes.push_back(error);
    }
  }
  for (uint32_t s = 0; s < clip.segments().size(); ++s)
    checked.bounds.push_back(bounds_of(clip, s));
  return checked;
}

}  // namespace anicodec
