// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: statuses, memory, opening, and what an asset says of itself.
#include "sdk/api/objects.h"
#include "sdk/clip/clock.h"
#include "sdk/clip/memory_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace anicodec {
namespace {

void* allocate_default(void*, size_t size, size_t) {
  return std::malloc(size);  // aligned for anything up to 16 bytes
}

void release_default(void*, void* memory, size_t) {
  std::free(memory);
}

/// Bytes that any file may take while it opens, and more for each byte of it: a kilobyte does not
/// get a gigabyte unless the host says so.
constexpr uint64_t kBytesAtLeast = uint64_t{1} << 28, kBytesPerByte = uint64_t{1} << 14;

/// What a block allocator may lose to fragmentation and bookkeeping: measured, with room to spare.
uint64_t block_bytes(uint64_t opening) {
  const uint64_t slack = opening / 4 + 65536;
  return opening + std::min(slack, UINT64_MAX - opening);
}

/// Triangles of fans.
uint32_t triangle_count(const Topology& t) {
  uint64_t count = 0;
  for (size_t p = 0; p + 1 < t.polygon_offsets.size(); ++p) {
    const uint32_t corners = t.polygon_offsets[p + 1] - t.polygon_offsets[p];
    count += corners < 3 ? 0 : corners - 2;
  }
  return static_cast<uint32_t>(count);
}

uint64_t box_bytes(const Limits& limits) {
  return sizeof(anic_box) * (uint64_t{limits.frames} + 1) * limits.meshes.size();
}

/// What a context keeps for the segments of one track; `shape`: bytes of one, if any are of MSGI.
uint64_t track_bytes(uint64_t weights, uint64_t segments, uint64_t interpolated, uint64_t shape) {
  return 2 * (sizeof(Sample) + sizeof(float) * weights * std::min<uint64_t>(segments, 2) +
              std::min<uint64_t>(interpolated, Sample::kMaxParts) * shape);
}

/// Of the meshes and segments of limits, as context_extra() finds it for an open clip.
uint64_t context_bytes(const Limits& limits, double quality) {
  const Vector<uint32_t> order = limits.segments_by_frame();
  Vector<uint8_t> has_track(limits.meshes.size(), 0);
  uint64_t bytes = object_bytes<anic_context>(), scratch = 0;
  for (size_t i = 0; i < order.size();) {
    const Limits::Segment& first = limits.segments[order[i]];
    uint64_t largest = 0, segments = 0, interpolated = 0;
    for (; i < order.size() && limits.segments[order[i]].same_track(first); ++i, ++segments) {
      const Limits::Segment& s = limits.segments[order[i]];
      const bool keyframes = s.kind == BasisKind::kKeyframes;
      const uint64_t components =
          keyframes ? s.components : wanted_components(quality, s.components);
      const uint64_t channels = s.kind == BasisKind::kEigentrajectories ? 3 : 1;
      largest = std::max(largest, channels * components);
      if (s.reconstruction == Reconstruction::kMsgi) {
        ++interpolated;
        scratch = std::max(scratch, shape_scratch_bytes(s.components, s.msgi_frame_bytes));
      }
    }
    if (first.attribute == kPositions)
      has_track[first.mesh] = 1;
    bytes += track_bytes(largest, segments, interpolated,
                         3 * sizeof(float) * limits.meshes[first.mesh].coded_vertices);
  }
  for (uint8_t has : has_track)
    bytes += has ? 0 : track_bytes(0, 0, 0, 0);
  return bytes + scratch;
}

template <class Indices>
void write_triangles(const Topology& t, Indices* out) {
  for (size_t p = 0; p + 1 < t.polygon_offsets.size(); ++p) {
    const uint32_t* corner = t.polygon_corners.data() + t.polygon_offsets[p];
    const uint32_t count = t.polygon_offsets[p + 1] - t.polygon_offsets[p];
    for (uint32_t i = 2; i < count; ++i) {
      for (uint32_t v : {corner[0], corner[i - 1], corner[i]}) {
        const auto index = static_cast<Indices>(v);
        std::memcpy(out++, &index, sizeof index);
      }
    }
  }
}

const Mesh* find_mesh(const anic_asset* asset, uint32_t mesh) {
  return asset && mesh < asset->clip.meshes().size() ? &asset->clip.meshes()[mesh] : nullptr;
}

}  // namespace

bool is_valid_options(const anic_options* options) {
  return !options || (options->quality >= 0 && options->quality <= 1 &&
                      (options->flags & ~static_cast<uint32_t>(ANIC_OPEN_BOUNDS)) == 0 &&
                      !options->allocator.allocate == !options->allocator.release);
}

anic_status report(const Failure& failure, anic_failure* out) {
  if (out) {
    *out = {};
    out->status = c_status(failure.status);
    out->offset = failure.offset;
    out->detail = failure.detail;
    for (int i = 0; i < 4 && failure.chunk; ++i)
      out->chunk[i] = static_cast<char>(failure.chunk >> (8 * i));
  }
  return c_status(failure.status);
}

Memory memory_of(const anic_allocator* allocator) {
  Memory memory;
  memory.allocate = allocate_default;
  memory.release = release_default;
  if (allocator && allocator->allocate) {
    memory.user = allocator->user;
    memory.allocate = allocator->allocate;
    memory.release = allocator->release;
  }
  return memory;
}

OpenOptions open_options(const anic_options* options, uint64_t file_size) {
  OpenOptions result;
  HostLimits& limits = result.limits;
  limits.resident_bytes =
      kBytesAtLeast +
      std::min(file_size, (UINT64_MAX - kBytesAtLeast) / kBytesPerByte) * kBytesPerByte;
  if (!options)
    return result;
  auto take = [](uint64_t value, uint64_t* limit) {
    if (value != 0)
      *limit = value;
  };
  take(options->limits.vertices, &limits.vertices);
  take(options->limits.frames, &limits.frames);
  take(options->limits.components, &limits.components);
  take(options->limits.bytes, &limits.resident_bytes);
  if (options->quality > 0)
    result.quality = options->quality;
  return result;
}

Failure open_asset(ByteView bytes, const anic_options* options, bool prefix, anic_asset** out) {
  // Of a stream, the bytes that have arrived count for the limit.
  OpenOptions opening = open_options(options, bytes.size);
  opening.prefix = prefix;
  anic_asset* asset = create<anic_asset>(memory_of(options ? &options->allocator : nullptr), 0);
  try {
    const MemoryScope scope(&memory_of_object(asset));
    if (Failure failure = asset->clip.open(bytes, opening); !failure.ok()) {
      destroy(asset);
      return failure;
    }
    const Clip& clip = asset->clip;
    asset->quality = opening.quality;
    asset->context_bytes = object_bytes<anic_context>(context_extra(clip));
    asset->triangle_counts.reserve(clip.meshes().size());
    for (const Mesh& mesh : clip.meshes())
      asset->triangle_counts.push_back(triangle_count(mesh.topology));
    if (options && options->flags & ANIC_OPEN_BOUNDS)
      compute_boxes(asset);
    asset->resident_bytes = memory_of_object(asset).held;
  } catch (...) {
    destroy(asset);
    throw;
  }
  *out = asset;
  return {};
}

}  // namespace anicodec

using namespace anicodec;

uint32_t anic_get_version(void) {
  return ANIC_VERSION_MAJOR << 16 | ANIC_VERSION_MINOR << 8 | ANIC_VERSION_PATCH;
}

const char* anic_get_status_text(anic_status status) {
  return status_string(static_cast<Status>(status));
}

anic_status anic_get_requirements(const void* head, size_t size, const anic_options* options,
                                  anic_requirements* out) {
  if (!out || (!head && size > 0) || !is_valid_options(options))
    return ANIC_E_ARGUMENT;
  *out = {};
  auto query = [&]() -> Failure {
    Memory memory = memory_of(options ? &options->allocator : nullptr);
    const MemoryScope scope(&memory);
    const ByteView bytes(static_cast<const uint8_t*>(head), size);
    ContainerReader file;
    out->head_bytes = ContainerReader::head_bytes(bytes);
    if (size == 0)
      return {Status::kTruncated, 0, 0, "nothing to look at"};
    if (Failure failure = file.open_prefix(bytes); !failure.ok())
      return failure;
    out->file_bytes = file.file_size();
    if (const Chunk* limits_chunk = file.find("LIMI"))
      out->head_bytes = std::max(out->head_bytes, limits_chunk->offset + limits_chunk->size);
    Limits limits;
    const OpenOptions opening = open_options(options, file.file_size());
    if (Failure failure = read_limits(file, opening, &limits); !failure.ok())
      return failure;
    const MemoryEstimate estimate = estimate_memory(limits, opening.quality);
    const bool boxes = options && options->flags & ANIC_OPEN_BOUNDS;
    const uint64_t more =
        object_bytes<anic_asset>() + 4 * limits.meshes.size() + (boxes ? box_bytes(limits) : 0);
    out->resident_bytes = estimate.resident + more;
    out->opening_bytes = estimate.opening + more;
    out->draco_bytes = estimate.draco;
    out->block_bytes = block_bytes(out->opening_bytes);
    out->context_bytes = context_bytes(limits, opening.quality);
    out->mesh_count = static_cast<uint32_t>(limits.meshes.size());
    out->segment_count = static_cast<uint32_t>(limits.segments.size());
    out->frame_count = limits.frames;
    for (const auto& mesh : limits.meshes)
      out->max_vertices = std::max(out->max_vertices, mesh.source_vertices);
    for (const auto& s : limits.segments)
      out->max_components = std::max(out->max_components, s.components);
    return {};
  };
  return c_status(guarded(query).status);
}

anic_status anic_open_asset(const void* file, size_t size, const anic_options* options,
                            anic_asset** out, anic_failure* failure) {
  if (out)
    *out = nullptr;
  if (!out || (!file && size > 0) || !is_valid_options(options))
    return report({Status::kArgument, 0, 0, "an argument makes no sense"}, failure);
  return report(guarded([&] {
                  return open_asset({static_cast<const uint8_t*>(file), size}, options, false, out);
                }),
                failure);
}

void anic_close_asset(anic_asset* asset) {
  destroy(asset);
}

anic_status anic_verify_asset(const anic_asset* asset) {
  if (!asset)
    return ANIC_E_ARGUMENT;
  if (asset->clip.is_partial() || asset->quality < 1)
    return ANIC_E_STATE;
  return c_status(asset->clip.check_hashes().status);
}

void anic_get_asset_info(const anic_asset* asset, anic_asset_info* out) {
  if (!asset || !out)
    return;
  const Clip& clip = asset->clip;
  const ClipRecord& record = clip.record();
  const Clock clock(record, clip.frame_count());
  *out = {};
  out->mesh_count = static_cast<uint32_t>(clip.meshes().size());
  out->segment_count = static_cast<uint32_t>(clip.segments().size());
  out->frame_count = clip.frame_count();
  out->rate_numerator = record.rate_numerator;
  out->rate_denominator = record.rate_denominator;
  out->rate_assumed = record.rate_assumed;
  out->uneven = !record.times.empty();
  out->loop = record.loop;
  out->closed = record.closed;
  out->massaged = record.massaged;
  out->partial = clip.is_partial();
  out->up = static_cast<anic_up_axis>(record.up);
  out->order = static_cast<anic_order>(record.order);
  out->start_time = clock.time(0);
  out->end_time = clock.time(clip.frame_count() - 1);
  out->loop_duration = clock.loop_duration();
  out->metres_per_unit = record.metres_per_unit;
  out->diagonal = record.diagonal;
  out->max_error = record.max_error;
  out->rmse = record.rmse;
  out->kg = record.kg;
  out->surface_error = record.surface_error;
  out->surface_error_mean = record.surface_error_mean;
  out->name = record.name.c_str();
  out->encoder = record.encoder.c_str();
  out->resident_bytes = asset->resident_bytes;
  out->context_bytes = asset->context_bytes;
}

anic_status anic_get_mesh(const anic_asset* asset, uint32_t mesh, anic_mesh* out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !out)
    return ANIC_E_ARGUMENT;
  const Topology& t = m->topology;
  out->name = m->name.c_str();
  out->vertex_count = static_cast<uint32_t>(t.vertex_coded.size());
  out->coded_vertex_count = t.coded_vertices;
  out->polygon_count = static_cast<uint32_t>(t.polygon_offsets.size() - 1);
  out->corner_count = static_cast<uint32_t>(t.polygon_corners.size());
  out->triangle_count = asset->triangle_counts[mesh];
  out->attribute_count = static_cast<uint32_t>(m->attributes.size());
  return ANIC_OK;
}

anic_status anic_get_attribute(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                               anic_attribute* out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !out || attribute >= m->attributes.size())
    return ANIC_E_ARGUMENT;
  const MeshAttribute& a = m->attributes[attribute];
  *out = {};
  out->name = a.header.name.c_str();
  out->kind = static_cast<anic_attribute_kind>(a.header.kind);
  out->domain = static_cast<anic_domain>(a.header.domain);
  out->count = a.header.elements(asset->clip.limits().meshes[mesh]);
  out->components = a.header.components();
  out->label_count = static_cast<uint32_t>(a.header.labels.size());
  out->values = out->components > 0 ? a.values.data() : nullptr;
  out->labels = out->components > 0 ? nullptr : a.labels.data();
  const auto [first, last] = asset->clip.attribute_tracks(mesh, attribute);
  out->moves = first != last;
  return ANIC_OK;
}

const char* anic_get_label_name(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                                uint32_t label) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || attribute >= m->attributes.size() ||
      label >= m->attributes[attribute].header.labels.size())
    return nullptr;
  return m->attributes[attribute].header.labels[label].c_str();
}

anic_status anic_get_polygons(const anic_asset* asset, uint32_t mesh, anic_polygons* out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !out)
    return ANIC_E_ARGUMENT;
  out->polygon_count = static_cast<uint32_t>(m->topology.polygon_offsets.size() - 1);
  out->offsets = m->topology.polygon_offsets.data();
  out->corners = m->topology.polygon_corners.data();
  return ANIC_OK;
}

anic_status anic_write_indices(const anic_asset* asset, uint32_t mesh, uint32_t index_bytes,
                               void* out, size_t size) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || (index_bytes != 2 && index_bytes != 4) ||
      (index_bytes == 2 && m->topology.vertex_coded.size() > 65536))
    return ANIC_E_ARGUMENT;
  const uint64_t needed = uint64_t{3} * index_bytes * asset->triangle_counts[mesh];
  if (!out && needed > 0)
    return ANIC_E_ARGUMENT;
  if (size < needed)
    return ANIC_E_BUFFER_SIZE;
  if (index_bytes == 2)
    write_triangles(m->topology, static_cast<uint16_t*>(out));
  else
    write_triangles(m->topology, static_cast<uint32_t*>(out));
  return ANIC_OK;
}

anic_status anic_get_coded_vertices(const anic_asset* asset, uint32_t mesh, const uint32_t** out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !out)
    return ANIC_E_ARGUMENT;
  *out = m->topology.vertex_coded.data();
  return ANIC_OK;
}

double anic_get_frame_time(const anic_asset* asset, uint32_t frame) {
  return asset ? Clock(asset->clip.record(), asset->clip.frame_count()).time(frame) : 0;
}

anic_status anic_get_basis(const anic_asset* asset, uint32_t segment, anic_basis* out) {
  if (!asset || !out || segment >= asset->clip.segments().size())
    return ANIC_E_ARGUMENT;
  const Segment& s = asset->clip.segments()[segment];
  if (s.frames == 0)
    return ANIC_E_SEGMENT;
  *out = {};
  out->kind = static_cast<anic_basis_kind>(s.kind);
  out->mesh = s.mesh;
  out->first_frame = s.first_frame;
  out->frame_count = s.frames;
  out->vertex_count = s.vertices;
  out->components = s.components;
  out->wide_components = s.wide_components;
  out->channels = s.channels();
  out->weight_channels = s.weight_channels();
  out->pose = s.pose.empty() ? nullptr : s.pose.data();
  out->wide = s.wide.data();
  out->narrow = s.narrow.data();
  out->pose_count = s.pose.size();
  out->wide_count = s.wide.size();
  out->narrow_count = s.narrow.size();
  out->attribute = s.attribute;
  out->first_component = s.first_component;
  out->vertex_shape = s.vertex_coded.empty() ? nullptr : s.vertex_coded.data();
  out->reconstruction = s.msgi.empty() ? ANIC_RECONSTRUCTION_LINEAR : ANIC_RECONSTRUCTION_MSGI;
  for (size_t i = 0; i < 3; ++i)
    out->origin[i] = static_cast<float>(s.origin[i]);
  return ANIC_OK;
}
