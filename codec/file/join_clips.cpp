// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/join_clips.h"

#include "codec/file/part_chunks.h"
#include "codec/sequence/error.h"
#include "format/container.h"
#include "format/records.h"
#include "sdk/clip/clip.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace anicodec {
namespace {

/// A part, opened.
struct OpenPart {
  explicit OpenPart(const ClipPart& source) : part(source) {
    check(reader.open(part.file));
    check_known_chunks(*this, part);
    check(Limits::read(payload(required("LIMI")), &limits));
    check(ClipsRecord::read(payload(required("CLIP")), limits, &record));
    if (limits.meshes.size() != 1)
      fail(part, ErrorKind::kUnsupported, "clips of several meshes are not joined");
    if (record.clips.size() != 1)
      fail(part, ErrorKind::kUnsupported, "has several clips, and is no part of one");
  }

  const ClipRecord& clip() const { return record.clips[0]; }

  void check(const Failure& failure) const {
    if (!failure.ok())
      fail(part, ErrorKind::kCorrupt, status_string(failure.status));
  }

  void check(Status status) const {
    if (status != Status::kOk)
      fail(part, ErrorKind::kCorrupt, status_string(status));
  }

  const Chunk& required(const char (&type)[5]) const {
    const Chunk* chunk = reader.find(type);
    if (!chunk)
      fail(part, ErrorKind::kCorrupt, std::string("has no chunk ") + type);
    return *chunk;
  }

  ByteView payload(const Chunk& chunk) const {
    ByteView view;
    check(reader.payload(chunk, &view));
    return view;
  }

  /// Payload of a chunk of the mesh, empty when there is none.
  ByteView of_mesh(const char (&type)[5]) const {
    const Chunk* chunk = reader.find(type, 0);
    return chunk ? payload(*chunk) : ByteView();
  }

  ClipPart part;
  ContainerReader reader;
  Limits limits;
  ClipsRecord record;
};

void check_same_mesh(const OpenPart& first, const OpenPart& next) {
  const Limits::Mesh &a = first.limits.meshes[0], &b = next.limits.meshes[0];
  auto counts = [](const Limits::Mesh& m) {
    return std::to_string(m.source_vertices) + " vertices and " + std::to_string(m.polygons) +
           " faces";
  };
  if (a.source_vertices != b.source_vertices || a.polygons != b.polygons || a.corners != b.corners)
    fail(next.part, ErrorKind::kInput,
         "has " + counts(b) + ", but " + first.part.name + " has " + counts(a));
  if (first.record.order != next.record.order)
    fail(next.part, ErrorKind::kInput, "keeps another order of vertices than " + first.part.name);
  if (!first.record.same_origin(next.record))
    fail(next.part, ErrorKind::kInput,
         "counts positions from another origin than " + first.part.name + ", see --origin");
  for (const ChunkKind& kind : kChunkKinds) {
    if (is_of_meshes(kind) && !equal(first.of_mesh(kind.name), next.of_mesh(kind.name)))
      fail(next.part, ErrorKind::kInput,
           "does not have the connectivity, welds and reference pose of " + first.part.name +
               "; parts are encoded from the whole clip, with --part and the same target");
  }
}

double duration(const OpenPart& part) {
  return part.limits.frames * double{1} * part.clip().rate_denominator / part.clip().rate_numerator;
}

void check_follows(const OpenPart& before, const OpenPart& next) {
  const ClipRecord &a = before.clip(), &b = next.clip();
  if (a.rate_numerator != b.rate_numerator || a.rate_denominator != b.rate_denominator ||
      before.record.up != next.record.up ||
      before.record.metres_per_unit != next.record.metres_per_unit ||
      a.times.empty() != b.times.empty())
    fail(next.part, ErrorKind::kInput,
         "has another frame rate, up axis or unit than " + before.part.name);
  const double frame = double{1} * a.rate_denominator / a.rate_numerator;
  const double gap = b.start_time - a.start_time;
  const bool follows =
      a.times.empty() ? std::abs(gap - duration(before)) < 0.01 * frame : gap > a.times.back();
  if (!follows)
    fail(next.part, ErrorKind::kInput,
         "starts at " + std::to_string(b.start_time) + " s and does not follow " +
             before.part.name + ", which starts at " + std::to_string(a.start_time) +
             " s and has " + std::to_string(before.limits.frames) + " frames");
}

ClipsRecord joined_record(const std::vector<OpenPart>& parts) {
  ClipsRecord joined = parts[0].record;
  ClipRecord& record = joined.clips[0];
  double squared = 0, reference = 0, frames = 0;
  record.times = {};
  for (const OpenPart& part : parts) {
    const ClipRecord& r = part.clip();
    const double of_part = r.rmse * r.rmse * part.limits.frames;
    squared += of_part;
    if (r.kg > 0)
      reference += of_part / (r.kg * r.kg / 1e4);
    frames += part.limits.frames;
    // The error of the move from one part to the next is only bounded, by the errors of its two
    // frames.
    const double seam = &part == parts.data() ? 0 : (&part)[-1].clip().max_error + r.max_error;
    record.max_displacement_error =
        std::max({record.max_displacement_error, r.max_displacement_error, seam});
    record.max_error = std::max(record.max_error, r.max_error);
    record.diagonal = std::max(record.diagonal, r.diagonal);
    record.surface_error = std::max(record.surface_error, r.surface_error);
    record.massaged |= r.massaged;
    if (r.asked != record.asked || r.asked_value != record.asked_value)
      record.asked = ErrorMetric::kNone;
    for (double t : r.times)
      record.times.push_back(r.start_time - record.start_time + t);
  }
  const bool of_motion = record.asked == ErrorMetric::kSted ||
                         (record.asked == ErrorMetric::kDisplacement &&
                          !(record.max_displacement_error <= record.asked_value));
  if (record.asked == ErrorMetric::kSize || record.asked == ErrorMetric::kNone || of_motion) {
    record.asked = ErrorMetric::kNone;
    record.asked_value = 0;
  }
  record.closed = false;
  record.rmse = std::sqrt(squared / frames);
  record.kg = reference > 0 ? 100 * std::sqrt(squared / reference) : 0;
  return joined;
}

/// Adds a chunk of a segment under its new number.
void add_chunk(const OpenPart& part, const Chunk& chunk, uint32_t segment, ContainerWriter& file) {
  if (goes_along(chunk))
    return file.add(chunk, 0, segment, copy(part.payload(chunk)));
  if (chunk.required)
    fail(part.part, ErrorKind::kUnsupported,
         "a chunk " + chunk_name(chunk.type) + " cannot be joined");
}

Failure verified(ByteView file) {
  Clip clip;
  Failure failure = clip.open(file);
  return failure.ok() ? clip.check_hashes() : failure;
}

/// Errors of attributes over all parts.
Vector<AttributeError> joined_errors(const std::vector<OpenPart>& parts) {
  struct Sum {
    AttributeError error;
    double squared = 0, frames = 0;
  };

  std::map<uint16_t, Sum> sums;
  for (const OpenPart& part : parts) {
    for (const AttributeError& e : part.clip().attribute_errors) {
      Sum& sum = sums[e.attribute];
      sum.error.attribute = e.attribute;
      sum.error.max_error = std::max(sum.error.max_error, e.max_error);
      sum.squared += e.rmse * e.rmse * part.limits.frames;
      sum.frames += part.limits.frames;
    }
  }
  Vector<AttributeError> errors;
  for (auto& [attribute, sum] : sums) {
    sum.error.rmse = std::sqrt(sum.squared / sum.frames);
    errors.push_back(sum.error);
  }
  return errors;
}

/// A segment of a part.
struct JoinedSegment {
  const OpenPart* part;
  Limits::Segment sizes;  ///< with frames of the joined clip
  std::vector<const Chunk*> chunks;
};

/// One file of parts in the order of time: mesh, maps and pose of the first one, all segments under new numbers.
Bytes join(const std::vector<OpenPart>& parts, ClipsRecord record) {
  record.clips[0].attribute_errors = joined_errors(parts);
  Limits limits;
  limits.meshes.push_back(parts[0].limits.meshes[0]);
  std::vector<JoinedSegment> segments;
  for (const OpenPart& part : parts) {
    const size_t first = segments.size();
    for (Limits::Segment sizes : part.limits.segments) {
      sizes.first_frame += limits.frames;
      segments.push_back({&part, sizes, {}});
    }
    for (const Chunk& chunk : part.reader.chunks()) {
      if (chunk.segment < part.limits.segments.size())
        segments[first + chunk.segment].chunks.push_back(&chunk);
    }
    limits.frames += part.limits.frames;
  }
  std::ranges::stable_sort(segments, {},
                           [](const JoinedSegment& segment) { return segment.sizes.first_frame; });
  for (const JoinedSegment& segment : segments)
    limits.segments.push_back(segment.sizes);

  ContainerWriter file;
  file.add("LIMI", kNoMesh, kNoSegment, limits.write());
  file.add("CLIP", kNoMesh, kNoSegment, record.write());
  add_copied(parts[0], kNoMesh, file);
  const auto add_segments = [&](ChunkPlace place) {
    for (uint32_t s = 0; s < segments.size(); ++s) {
      for (const Chunk* chunk : segments[s].chunks) {
        if (place_of(*chunk) == place)
          add_chunk(*segments[s].part, *chunk, s, file);
      }
    }
  };
  add_segments(ChunkPlace::kBeforeMeshes);
  add_mesh(parts[0], file);
  add_segments(ChunkPlace::kWithSegment);
  add_segments(ChunkPlace::kBehindSegments);
  Bytes bytes = file.finish(limits.features());
  const Failure failure = verified(bytes);
  if (failure.ok())
    return bytes;
  // The payloads are copied: a part that is not valid shows only now.
  for (const OpenPart& part : parts)
    part.check(verified(part.part.file));
  throw Error(ErrorKind::kInternal,
              std::string("the joined file is not valid: ") + status_string(failure.status));
}

}  // namespace

Bytes join_clips(const std::vector<ClipPart>& sources) {
  if (sources.empty())
    throw Error(ErrorKind::kUsage, "there is no part to join");
  std::vector<OpenPart> parts;
  for (const ClipPart& source : sources)
    parts.emplace_back(source);
  std::stable_sort(parts.begin(), parts.end(), [](const OpenPart& a, const OpenPart& b) {
    return a.clip().start_time < b.clip().start_time;
  });
  uint32_t frames = 0;
  for (size_t i = 0; i < parts.size(); ++i) {
    const OpenPart& part = parts[i];
    if (i > 0) {
      check_same_mesh(parts[0], part);
      check_follows(parts[i - 1], part);
    }
    if (part.limits.frames > kMaxFrames - frames)
      fail(part.part, ErrorKind::kInput, "together there are more than 2^24 - 1 frames");
    frames += part.limits.frames;
  }
  return join(parts, joined_record(parts));
}

}  // namespace anicodec
