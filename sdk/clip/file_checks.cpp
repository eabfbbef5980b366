// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/file_checks.h"

#include "format/chunk_kinds.h"
#include "sdk/clip/clip.h"
#include "sdk/clip/memory_estimate.h"
#include "sdk/mesh/draco_poses.h"
#include "sdk/msgi/msgi.h"

#include <algorithm>

namespace anicodec {

Failure failure_in(const Chunk& chunk, Status status, const char* detail) {
  return {status, chunk.offset, chunk.type, detail};
}

Failure check_chunks(const ContainerReader& file) {
  for (const Chunk& chunk : file.chunks()) {
    if (chunk.required && !find_chunk_kind(chunk.type))
      return failure_in(chunk, Status::kChunkUnknown,
                        "the file needs a chunk this reader does not know");
  }
  for (size_t i = 1; i < file.by_key().size(); ++i) {
    const Chunk &a = file.chunks()[file.by_key()[i - 1]], &b = file.chunks()[file.by_key()[i]];
    const ChunkKind* kind = chunk_key(a) == chunk_key(b) ? find_chunk_kind(b.type) : nullptr;
    if (kind && !kind->repeats)
      return failure_in(b, Status::kChunkDuplicate, "a chunk occurs twice");
  }
  return {};
}

namespace {

/// The optional profile.
Failure check_features(uint64_t features) {
  constexpr uint64_t kFeaturesAt = 16;
  if ((features & kDracoFeature) && !has_draco())
    return {Status::kFeature, kFeaturesAt, 0,
            "the file needs feature 1 (key-frames by Draco), which this decoder lacks"};
  if ((features & kMsgiFeature) && !Msgi::is_there())
    return {Status::kFeature, kFeaturesAt, 0,
            "the file needs feature 2 (geometry interpolation), which this decoder lacks"};
  return {};
}

}  // namespace

Failure check_places(const ContainerReader& file, const Limits& limits, OrderMode order) {
  auto fits = [&](const Chunk& chunk, ChunkOwner owner) {
    const bool of_segment = chunk.segment != kNoSegment;
    if (owner == ChunkOwner::kClip)
      return chunk.mesh == kNoMesh && !of_segment &&
             (chunk.type != chunk_type("ROOT") || limits.root_frames > 0);
    if (chunk.mesh >= limits.meshes.size() || (owner == ChunkOwner::kMesh && of_segment) ||
        (owner == ChunkOwner::kSegment && !of_segment))
      return false;
    if (chunk.type == chunk_type("ATTR"))
      return limits.meshes[chunk.mesh].attributes > 0;
    if (!of_segment)
      return (chunk.type != chunk_type("VMAP") || order != OrderMode::kFree) &&
             (chunk.type != chunk_type("FMAP") || order == OrderMode::kAll);
    if (chunk.segment >= limits.segments.size())
      return false;
    const Limits::Segment& segment = limits.segments[chunk.segment];
    if (segment.mesh != chunk.mesh)
      return false;
    if (chunk.type == chunk_type("CORR"))
      return segment.corrections > 0;
    if (chunk.type == chunk_type("DIFF"))
      return segment.exact;
    if (chunk.type == chunk_type("BNDS"))
      return segment.attribute == kPositions;
    if (chunk.type == chunk_type("POSE") && segment.attribute != kPositions)
      return false;
    return chunk.type == chunk_type("SEGM") || segment.kind != BasisKind::kKeyframes;
  };
  for (const Chunk& chunk : file.chunks()) {
    const ChunkKind* kind = find_chunk_kind(chunk.type);
    if (kind && !(chunk.required == kind->required && chunk.copied == kind->copied &&
                  fits(chunk, kind->owner)))
      return failure_in(chunk, Status::kIndexRange, "a chunk belongs to nothing in the file");
  }
  return {};
}

Failure required_payload(const ContainerReader& file, const char (&type)[5], uint16_t mesh,
                         uint32_t segment, const Chunk** chunk, ByteView* out) {
  *chunk = file.find(type, mesh, segment);
  if (!*chunk)
    return {Status::kChunkMissing, 0, chunk_type(type), "a required chunk is missing"};
  return file.payload(**chunk, out);
}

Failure read_limits(const ContainerReader& file, const OpenOptions& options, Limits* out) {
  if (Failure failure = check_features(file.features()); !failure.ok())
    return failure;
  if (Failure failure = check_chunks(file); !failure.ok())
    return failure;

  const Chunk* chunk;
  ByteView payload;
  if (Failure f = required_payload(file, "LIMI", kNoMesh, kNoSegment, &chunk, &payload); !f.ok())
    return f;
  if (Status s = Limits::read(payload, out); s != Status::kOk)
    return failure_in(*chunk, s, "the limits are malformed");
  if ((file.features() & ~kContinuation) != out->features())
    return failure_in(*chunk, Status::kRecord, "the header announces other features");
  // Even a mesh that is all alike takes some thousandth of a bit per vertex.
  const uint64_t plausible = std::min(file.file_size(), UINT64_MAX >> 22) << 16;
  for (const auto& mesh : out->meshes) {
    if (mesh.source_vertices > options.limits.vertices)
      return failure_in(*chunk, Status::kLimit, "more vertices than allowed");
    if (mesh.source_vertices > plausible || mesh.corners > plausible ||
        mesh.triangles > plausible || mesh.polygons > plausible)
      return failure_in(*chunk, Status::kLimit, "counts that no file of this size can hold");
  }
  if (out->frames > options.limits.frames)
    return failure_in(*chunk, Status::kLimit, "more frames than allowed");
  // Decisions over the frames that have corrections, against what else there is to decode.
  uint64_t decisions = 0, allowed = uint64_t{1} << 20;
  for (const auto& s : out->segments) {
    const Limits::Mesh mesh = s.coded_over(out->meshes[s.mesh]);
    if (s.components > options.limits.components)
      return failure_in(*chunk, Status::kLimit, "more components than allowed");
    const BasisTraits traits = traits_of(s.kind);
    const uint64_t coefficients = uint64_t{traits.channels} * s.components * mesh.coded_vertices;
    const uint64_t weights =
        uint64_t{4} * s.regions * s.frames * s.components * traits.weight_channels;
    if (coefficients > plausible * 64 || weights > plausible * 64)
      return failure_in(*chunk, Status::kLimit, "counts that no file of this size can hold");
    if (s.draco_bytes > file.file_size() || s.draco_points / 3 > mesh.triangles)
      return failure_in(*chunk, Status::kLimit, "more of Draco than the mesh or the file can hold");
    if (s.exact && uint64_t{s.frames} * mesh.coded_vertices > plausible)
      return failure_in(*chunk, Status::kLimit,
                        "more exact positions than a file of this size can hold");
    decisions += uint64_t{std::min(s.frames, s.corrections)} * block_count(mesh.coded_vertices);
    allowed += coefficients + weights / 4;
  }
  if (decisions / 16 > allowed + std::min(file.file_size(), UINT64_MAX >> 8) * 16)
    return failure_in(*chunk, Status::kLimit,
                      "more frames with corrections than so few numbers can need");
  if (estimate_memory(*out, options.quality, options.opens_exact()).opening >
      options.limits.resident_bytes)
    return failure_in(*chunk, Status::kLimit, "more memory than allowed");
  return {};
}

}  // namespace anicodec
