// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip.h"

#include "sdk/plain_coding.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

using format::ByteView;
using format::Chunk;
using format::chunk_type;

constexpr uint32_t kKnownChunks[] = {chunk_type("LIMI"), chunk_type("CLIP"), chunk_type("MESH"),
                                     chunk_type("VMAP"), chunk_type("FMAP"), chunk_type("POSE"),
                                     chunk_type("SEGM"), chunk_type("BASI"), chunk_type("CORR")};

Failure at(const Chunk& chunk, Status status, const char* detail) {
  return {status, chunk.offset, chunk.type, detail};
}

/// Unknown chunks are skipped, unless required; only layers of a basis may occur twice.
Failure check_chunks(const format::ContainerReader& file) {
  std::vector<std::pair<uint64_t, const Chunk*>> keys;
  for (const Chunk& chunk : file.chunks()) {
    bool known = std::find(std::begin(kKnownChunks), std::end(kKnownChunks), chunk.type) !=
                 std::end(kKnownChunks);
    if (!known && chunk.required)
      return at(chunk, Status::kChunkUnknown, "the file needs a chunk this reader does not know");
    if (known && chunk.type != chunk_type("BASI"))
      keys.emplace_back((uint64_t{chunk.type} << 32) ^ (uint64_t{chunk.mesh} << 48) ^ chunk.segment,
                        &chunk);
  }
  std::sort(keys.begin(), keys.end());
  for (size_t i = 1; i < keys.size(); ++i) {
    const Chunk &a = *keys[i - 1].second, &b = *keys[i].second;
    if (a.type == b.type && a.mesh == b.mesh && a.segment == b.segment)
      return at(b, Status::kChunkDuplicate, "a chunk occurs twice");
  }
  return {};
}

/// The payload of a chunk that must be there.
Failure required(const format::ContainerReader& file, const char (&type)[5], uint16_t mesh,
                 uint32_t segment, const Chunk** chunk, ByteView* out) {
  *chunk = file.find(type, mesh, segment);
  if (!*chunk)
    return {Status::kChunkMissing, 0, chunk_type(type), "a required chunk is missing"};
  return file.payload(**chunk, out);
}

}  // namespace

Failure Clip::open(ByteView bytes, const OpenOptions& options) {
  *this = Clip();
  format::ContainerReader file;
  if (Failure failure = file.open(bytes); !failure.ok())
    return failure;
  if (Failure failure = check_chunks(file); !failure.ok())
    return failure;

  const Chunk* chunk;
  ByteView payload;
  if (Failure f = required(file, "LIMI", format::kNoMesh, format::kNoSegment, &chunk, &payload);
      !f.ok())
    return f;
  if (Status s = format::Limits::read(payload, &limits_); s != Status::kOk)
    return at(*chunk, s, "the limits are malformed");
  uint64_t resident = 0;
  // Even a mesh that is all alike takes some thousandth of a bit per vertex.
  uint64_t plausible = uint64_t{bytes.size} << 16;
  for (const auto& mesh : limits_.meshes) {
    if (mesh.source_vertices > options.limits.vertices)
      return at(*chunk, Status::kLimit, "more vertices than allowed");
    if (mesh.source_vertices > plausible || mesh.corners > plausible ||
        mesh.triangles > plausible || mesh.polygons > plausible || mesh.points > plausible ||
        mesh.draco_bytes > bytes.size)
      return at(*chunk, Status::kLimit, "counts that no file of this size can hold");
    resident += uint64_t{4} * mesh.source_vertices + uint64_t{8} * mesh.corners;
  }
  if (limits_.frames > options.limits.frames)
    return at(*chunk, Status::kLimit, "more frames than allowed");
  for (const auto& s : limits_.segments) {
    if (s.components > options.limits.components)
      return at(*chunk, Status::kLimit, "more components than allowed");
    uint64_t channels = s.kind == format::BasisKind::kEigentrajectories ? 1 : 3;
    uint64_t coefficients = channels * s.components * limits_.meshes[s.mesh].coded_vertices;
    uint64_t weights = uint64_t{4} * s.frames * s.components * (channels == 1 ? 3 : 1);
    if (coefficients > plausible * 64 || weights > plausible * 64)
      return at(*chunk, Status::kLimit, "counts that no file of this size can hold");
    resident += 2 * coefficients + weights + uint64_t{16} * s.corrections;
  }
  if (resident > options.limits.resident_bytes)
    return at(*chunk, Status::kLimit, "more memory than allowed");

  if (Failure f = required(file, "CLIP", format::kNoMesh, format::kNoSegment, &chunk, &payload);
      !f.ok())
    return f;
  if (Status s = format::ClipRecord::read(payload, limits_.frames, &record_); s != Status::kOk)
    return at(*chunk, s, "the clip record is malformed");

  meshes_.resize(limits_.meshes.size());
  draco_.resize(limits_.meshes.size());
  Failure failure;
  for (size_t m = 0; m < meshes_.size() && failure.ok(); ++m)
    failure = open_mesh(file, static_cast<uint16_t>(m));
  if (failure.ok())
    failure = open_segments(file, options);
  draco_.clear();
  draco_.shrink_to_fit();
  if (!failure.ok())
    *this = Clip();
  return failure;
}

Failure Clip::open_mesh(const format::ContainerReader& file, uint16_t mesh) {
  const format::Limits::Mesh& sizes = limits_.meshes[mesh];
  const Chunk* chunk;
  ByteView payload;
  if (Failure f = required(file, "MESH", mesh, format::kNoSegment, &chunk, &payload); !f.ok())
    return f;
  format::MeshRecord record;
  if (Status s = format::MeshRecord::read(payload, &record); s != Status::kOk)
    return at(*chunk, s, "the mesh record is malformed");
  DracoMesh& draco = draco_[mesh];
  if (record.coder == format::CoderId::kDraco) {
    if (record.connectivity.size != sizes.draco_bytes)
      return at(*chunk, Status::kRecord, "the Draco bitstream is not as long as the limits say");
    Status s = decode_draco_mesh(record.connectivity, sizes.points, sizes.triangles,
                                 sizes.draco_components, &draco);
    if (s != Status::kOk)
      return at(*chunk, s, "the Draco bitstream is damaged");
  } else {
    if (sizes.draco_components != 0)
      return at(*chunk, Status::kRecord, "Draco components without Draco");
    Status s = decode_plain_triangles(record.connectivity, sizes.triangles, &draco.triangles);
    if (s != Status::kOk)
      return at(*chunk, s, "the plain connectivity is damaged");
  }
  Mesh& out = meshes_[mesh];
  out.name = record.name;
  if (Status s = decode_details(record.details, sizes, draco.triangles, &out.topology);
      s != Status::kOk)
    return at(*chunk, s, "the mesh details are damaged");

  if (record_.order == format::OrderMode::kFree)
    return {};
  if (Failure f = required(file, "VMAP", mesh, format::kNoSegment, &chunk, &payload); !f.ok())
    return f;
  std::vector<uint32_t> map;
  if (Status s = decode_vertex_map(payload, sizes.source_vertices, &map); s != Status::kOk)
    return at(*chunk, s, "the vertex map is damaged");
  if (record_.order == format::OrderMode::kAll) {
    if (Failure f = required(file, "FMAP", mesh, format::kNoSegment, &chunk, &payload); !f.ok())
      return f;
    std::vector<uint32_t> place, first;
    if (Status s = decode_face_map(payload, out.topology, &place, &first); s != Status::kOk)
      return at(*chunk, s, "the face map is damaged");
    apply_face_map(place, first, &out.topology);
  }
  apply_vertex_map(map, &out.topology);
  return {};
}

Failure Clip::open_segments(const format::ContainerReader& file, const OpenOptions& options) {
  segments_.resize(limits_.segments.size());
  // Layers by segment, in file order, in one pass.
  std::vector<std::vector<const Chunk*>> layers(segments_.size());
  for (const Chunk& chunk : file.chunks()) {
    if (chunk.type == chunk_type("BASI") && chunk.segment < layers.size())
      layers[chunk.segment].push_back(&chunk);
  }
  auto read_pose = [&](const format::ContainerReader& from, const Chunk& chunk, PoseGrid* out) {
    ByteView payload;
    if (Failure f = from.payload(chunk, &payload); !f.ok())
      return f;
    format::PoseRecord record;
    Status s = format::PoseRecord::read(payload, &record);
    if (s == Status::kOk)
      s = open_pose(record, meshes_[chunk.mesh].topology, draco_[chunk.mesh], out);
    return s == Status::kOk ? Failure{} : at(chunk, s, "the reference pose is damaged");
  };
  std::vector<PoseGrid> poses(meshes_.size());
  for (size_t m = 0; m < meshes_.size(); ++m) {
    if (const Chunk* chunk = file.find("POSE", static_cast<uint16_t>(m))) {
      if (Failure f = read_pose(file, *chunk, &poses[m]); !f.ok())
        return f;
    }
  }
  for (uint32_t i = 0; i < segments_.size(); ++i) {
    const format::Limits::Segment& sizes = limits_.segments[i];
    const Chunk* chunk;
    ByteView payload;
    if (Failure f = required(file, "SEGM", sizes.mesh, i, &chunk, &payload); !f.ok())
      return f;
    format::SegmentRecord record;
    Status s = format::SegmentRecord::read(payload, &record);
    if (s == Status::kOk && record.kind != sizes.kind)
      s = Status::kSegment;
    if (s != Status::kOk)
      return at(*chunk, s, "the segment record is malformed");
    SegmentContext context;
    context.sizes = &sizes;
    context.mesh_sizes = &limits_.meshes[sizes.mesh];
    context.topology = &meshes_[sizes.mesh].topology;
    context.draco = &draco_[sizes.mesh];
    PoseGrid own;
    context.pose = &poses[sizes.mesh];
    if (const Chunk* chunk_of_pose = file.find("POSE", sizes.mesh, i)) {
      if (Failure f = read_pose(file, *chunk_of_pose, &own); !f.ok())
        return f;
      context.pose = &own;
    }
    if (context.pose->points.empty())
      context.pose = nullptr;
    context.quality = options.quality;
    for (const Chunk* layer : layers[i]) {
      ByteView bytes;
      if (Failure f = file.payload(*layer, &bytes); !f.ok())
        return f;
      context.layers.push_back(bytes);
    }
    if (const Chunk* corrections = file.find("CORR", sizes.mesh, i)) {
      if (Failure f = file.payload(*corrections, &context.corrections); !f.ok())
        return f;
    }
    Segment& segment = segments_[i];
    s = open_segment(record, context, &segment);
    if (s != Status::kOk)
      return at(*chunk, s, "the segment cannot be opened");
  }
  return {};
}

const Segment* Clip::segment_at(uint32_t mesh, uint32_t frame) const {
  for (const Segment& s : segments_) {
    if (s.mesh == mesh && frame >= s.first_frame && frame - s.first_frame < s.frames)
      return &s;
  }
  return nullptr;
}

size_t Clip::resident_bytes() const {
  size_t total = 0;
  for (const Mesh& m : meshes_)
    total += 4 * (m.topology.triangles.size() + m.topology.point_vertex.size() +
                  m.topology.vertex_coded.size() + m.topology.polygon_offsets.size() +
                  m.topology.polygon_corners.size());
  for (const Segment& s : segments_)
    total += s.resident_bytes();
  return total;
}

Failure Clip::check_hashes() const {
  for (const Segment& s : segments_) {
    if (s.stored_hash != s.decoded_hash)
      return {Status::kHash, 0, chunk_type("SEGM"), "a segment decodes to other integers"};
  }
  return {};
}

FramePlayer::FramePlayer(const Clip& clip, uint32_t mesh) : clip_(clip), mesh_(mesh) {
  const std::vector<uint32_t>& coded = clip.meshes()[mesh].topology.vertex_coded;
  identity_ = true;
  for (uint32_t v = 0; v < coded.size() && identity_; ++v)
    identity_ = coded[v] == v;
  if (!identity_)
    scratch_.resize(size_t{3} * clip.meshes()[mesh].topology.coded_vertices);
}

Status FramePlayer::positions(uint32_t frame, float* out) {
  if (frame >= clip_.frame_count())
    return Status::kFrameRange;
  const Segment* segment = clip_.segment_at(mesh_, frame);
  if (!segment)
    return Status::kSegment;
  float* coded = identity_ ? out : scratch_.data();
  combine(*segment, frame - segment->first_frame, coded);
  if (identity_)
    return Status::kOk;
  const std::vector<uint32_t>& map = clip_.meshes()[mesh_].topology.vertex_coded;
  for (uint32_t c : map) {
    std::copy_n(coded + size_t{3} * c, 3, out);
    out += 3;
  }
  return Status::kOk;
}

}  // namespace anicodec
