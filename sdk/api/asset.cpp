// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: what an asset says of itself.
#include "sdk/api/objects.h"
#include "sdk/clip/clock.h"
#include "sdk/mesh/polygon_cutter.h"

#include <algorithm>
#include <cstring>

namespace anicodec {
namespace {

/// Positions of the first frame that shows a mesh; none of a mesh of triangles, or of one that no frame shows.
Vector<float> cutting_pose(const Clip& clip, uint32_t mesh) {
  Vector<float> pose;
  const Track& track = clip.tracks()[mesh];
  if (track.begin == track.end || !has_larger_polygons(clip.meshes()[mesh].topology))
    return pose;
  pose.resize(size_t{3} * clip.vertex_count(mesh));
  show_positions(clip, mesh, clip.segments()[clip.by_frame()[track.begin]].first_frame,
                 pose.data());
  return pose;
}

void write_triangles(const Topology& t, const Vector<float>& pose, uint32_t index_bytes,
                     unsigned char* out) {
  PolygonCutter cutter(pose.empty() ? nullptr : pose.data(), t.polygon_corners.size());
  Vector<uint32_t> triangles;
  for (size_t p = 0; p + 1 < t.polygon_offsets.size(); ++p) {
    const uint32_t* corner = t.polygon_corners.data() + t.polygon_offsets[p];
    triangles.clear();
    cutter.cut(corner, t.polygon_offsets[p + 1] - t.polygon_offsets[p], &triangles);
    for (const uint32_t c : triangles) {
      const auto narrow = static_cast<uint16_t>(corner[c]);
      if (index_bytes == 2)
        std::memcpy(out, &narrow, 2);
      else
        std::memcpy(out, &corner[c], 4);
      out += index_bytes;
    }
  }
}

const Mesh* find_mesh(const anic_asset* asset, uint32_t mesh) {
  return asset && mesh < asset->clip.meshes().size() ? &asset->clip.meshes()[mesh] : nullptr;
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

anic_status anic_get_asset_info(const anic_asset* asset, anic_asset_info* out) {
  if (!asset || !is_sized(out))
    return ANIC_E_ARGUMENT;
  const Clip& clip = asset->clip;
  anic_clip first = ANIC_INIT(anic_clip);
  anic_get_clip(asset, 0, &first);
  anic_asset_info filled = ANIC_INIT(anic_asset_info);
  filled.mesh_count = static_cast<uint32_t>(clip.meshes().size());
  filled.segment_count = static_cast<uint32_t>(clip.segments().size());
  filled.frame_count = clip.frame_count();
  filled.rate_numerator = first.rate_numerator;
  filled.rate_denominator = first.rate_denominator;
  filled.rate_assumed = first.rate_assumed;
  filled.uneven = first.uneven;
  filled.loop = first.loop;
  filled.closed = first.closed;
  filled.massaged = first.massaged;
  filled.partial = clip.is_partial();
  filled.up = static_cast<anic_up_axis>(clip.record().up);
  filled.order = static_cast<anic_order>(clip.record().order);
  filled.start_time = first.start_time;
  filled.duration = first.duration;
  filled.loop_duration = first.loop_duration;
  filled.metres_per_unit = clip.record().metres_per_unit;
  std::copy_n(clip.record().origin, 3, filled.origin);
  filled.diagonal = first.diagonal;
  filled.max_error = first.max_error;
  filled.rmse = first.rmse;
  filled.kg = first.kg;
  filled.max_displacement_error = first.max_displacement_error;
  filled.surface_error = first.surface_error;
  filled.surface_error_mean = first.surface_error_mean;
  filled.name = first.name;
  filled.encoder = clip.record().encoder.c_str();
  filled.resident_bytes = asset->resident_bytes;
  filled.context_bytes = asset->file->context_bytes;
  give(filled, out);
  return ANIC_OK;
}

uint32_t anic_get_clip_count(const anic_asset* asset) {
  return asset ? static_cast<uint32_t>(asset->clip.clips().size()) : 0;
}

anic_status anic_get_clip(const anic_asset* asset, uint32_t clip, anic_clip* out) {
  if (clip >= anic_get_clip_count(asset) || !is_sized(out))
    return ANIC_E_ARGUMENT;
  const ClipRecord& record = asset->clip.clips()[clip];
  const Clock clock(record);
  anic_clip filled = ANIC_INIT(anic_clip);
  filled.name = record.name.c_str();
  filled.first_frame = record.first_frame;
  filled.frame_count = record.frames;
  filled.rate_numerator = record.rate_numerator;
  filled.rate_denominator = record.rate_denominator;
  filled.rate_assumed = record.rate_assumed;
  filled.uneven = !record.times.empty();
  filled.loop = record.loop;
  filled.closed = record.closed;
  filled.massaged = record.massaged;
  filled.open = asset->has_clip(clip);
  filled.start_time = clock.start();
  filled.duration = clock.time(record.frames - 1);
  filled.loop_duration = clock.loop_duration();
  filled.diagonal = record.diagonal;
  filled.max_error = record.max_error;
  filled.rmse = record.rmse;
  filled.kg = record.kg;
  filled.max_displacement_error = record.max_displacement_error;
  filled.surface_error = record.surface_error;
  filled.surface_error_mean = record.surface_error_mean;
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_find_clip(const anic_asset* asset, const char* name, uint32_t* out) {
  if (!asset || !name || !out)
    return ANIC_E_ARGUMENT;
  *out = static_cast<uint32_t>(asset->clip.record().find(name));
  return *out < anic_get_clip_count(asset) ? ANIC_OK : ANIC_E_ABSENT;
}

uint32_t anic_get_event_count(const anic_asset* asset, uint32_t clip) {
  return clip < anic_get_clip_count(asset)
             ? static_cast<uint32_t>(asset->clip.clips()[clip].events.size())
             : 0;
}

anic_status anic_get_event(const anic_asset* asset, uint32_t clip, uint32_t event,
                           anic_event* out) {
  if (event >= anic_get_event_count(asset, clip) || !is_sized(out))
    return ANIC_E_ARGUMENT;
  const ClipEvent& of_file = asset->clip.clips()[clip].events[event];
  anic_event filled = ANIC_INIT(anic_event);
  filled.name = of_file.name.c_str();
  filled.seconds = of_file.seconds;
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_get_mesh(const anic_asset* asset, uint32_t mesh, anic_mesh* out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !is_sized(out))
    return ANIC_E_ARGUMENT;
  const Topology& t = m->topology;
  anic_mesh filled = ANIC_INIT(anic_mesh);
  filled.name = m->name.c_str();
  filled.vertex_count = static_cast<uint32_t>(t.vertex_coded.size());
  filled.coded_vertex_count = t.coded_vertices;
  filled.polygon_count = static_cast<uint32_t>(t.polygon_offsets.size() - 1);
  filled.corner_count = static_cast<uint32_t>(t.polygon_corners.size());
  filled.triangle_count = asset->file->triangle_counts[mesh];
  filled.attribute_count = static_cast<uint32_t>(m->attributes.size());
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_get_attribute(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                               anic_attribute* out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !is_sized(out) || attribute >= m->attributes.size())
    return ANIC_E_ARGUMENT;
  const MeshAttribute& a = m->attributes[attribute];
  anic_attribute filled = ANIC_INIT(anic_attribute);
  filled.name = a.header.name.c_str();
  filled.kind = static_cast<anic_attribute_kind>(a.header.kind);
  filled.domain = static_cast<anic_domain>(a.header.domain);
  filled.count = a.header.elements(asset->clip.limits().meshes[mesh]);
  filled.components = a.header.components();
  filled.label_count = static_cast<uint32_t>(a.header.labels.size());
  filled.values = filled.components > 0 ? a.values.data() : nullptr;
  filled.labels = filled.components > 0 ? nullptr : a.labels.data();
  const auto [first, last] = asset->clip.attribute_tracks(mesh, attribute);
  filled.moves = first != last;
  give(filled, out);
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

anic_status anic_get_material(const anic_asset* asset, uint32_t mesh, uint32_t attribute,
                              uint32_t label, anic_material* out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !is_sized(out) || attribute >= m->attributes.size())
    return ANIC_E_ARGUMENT;
  const AttributeHeader& a = m->attributes[attribute].header;
  if (a.kind != AttributeKind::kMaterial || label >= a.labels.size())
    return ANIC_E_ARGUMENT;
  if (a.looks.empty() || !a.looks[label].known)
    return ANIC_E_ABSENT;
  const MaterialLook& look = a.looks[label];
  anic_material filled = ANIC_INIT(anic_material);
  filled.name = a.labels[label].c_str();
  std::copy(look.base_colour.begin(), look.base_colour.end(), filled.base_colour);
  filled.metallic = look.metallic;
  filled.roughness = look.roughness;
  std::copy(look.emissive.begin(), look.emissive.end(), filled.emissive);
  filled.alpha = static_cast<anic_alpha>(look.alpha);
  filled.alpha_cutoff = look.alpha_cutoff;
  filled.double_sided = look.double_sided;
  filled.base_colour_texture = look.texture(TextureSlot::kBaseColour).c_str();
  filled.metallic_roughness_texture = look.texture(TextureSlot::kMetallicRoughness).c_str();
  filled.normal_texture = look.texture(TextureSlot::kNormal).c_str();
  filled.occlusion_texture = look.texture(TextureSlot::kOcclusion).c_str();
  filled.emissive_texture = look.texture(TextureSlot::kEmissive).c_str();
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_get_polygons(const anic_asset* asset, uint32_t mesh, anic_polygons* out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !is_sized(out))
    return ANIC_E_ARGUMENT;
  anic_polygons filled = ANIC_INIT(anic_polygons);
  filled.polygon_count = static_cast<uint32_t>(m->topology.polygon_offsets.size() - 1);
  filled.offsets = m->topology.polygon_offsets.data();
  filled.corners = m->topology.polygon_corners.data();
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_write_indices(const anic_asset* asset, uint32_t mesh, uint32_t index_bytes,
                               void* out, size_t size) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || (index_bytes != 2 && index_bytes != 4) ||
      (index_bytes == 2 && m->topology.vertex_coded.size() > 65536))
    return ANIC_E_ARGUMENT;
  const uint64_t needed = uint64_t{3} * index_bytes * asset->file->triangle_counts[mesh];
  if (!out && needed > 0)
    return ANIC_E_ARGUMENT;
  if (size < needed)
    return ANIC_E_BUFFER_SIZE;
  auto write = [&]() -> Failure {
    Memory memory = memory_of_object(asset);
    memory.held = memory.peak = 0;
    const MemoryScope scope(&memory);
    write_triangles(m->topology, cutting_pose(asset->clip, mesh), index_bytes,
                    static_cast<unsigned char*>(out));
    return {};
  };
  return c_status(guarded(write).status);
}

anic_status anic_get_coded_vertices(const anic_asset* asset, uint32_t mesh, const uint32_t** out) {
  const Mesh* m = find_mesh(asset, mesh);
  if (!m || !out)
    return ANIC_E_ARGUMENT;
  *out = m->topology.vertex_coded.data();
  return ANIC_OK;
}

double anic_get_frame_time(const anic_asset* asset, uint32_t frame) {
  if (!asset)
    return 0;
  const Clip& clip = asset->clip;
  frame = std::min(frame, clip.frame_count() - 1);
  const ClipRecord& record = clip.clips()[clip.clip_at(frame)];
  return Clock(record).time(frame - record.first_frame);
}
