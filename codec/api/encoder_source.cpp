// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Meshes, positions and attributes of the host.
#include "codec/api/encoder_objects.h"
#include "codec/api/guarded.h"
#include "sdk/api/versioned.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace anicodec {
namespace {

[[noreturn]] void fail(anic_status status, const std::string& text) {
  throw EncoderFailure(status, text);
}

std::string text_of(const char* text) {
  return text ? text : "";
}

Polygons polygons_of(const anic_source_mesh& host) {
  Polygons polygons;
  const size_t count = host.polygon_count;
  if (count == 0)
    return polygons;
  if (!host.corners)
    fail(ANIC_E_ARGUMENT, "the mesh has polygons and no corners");
  polygons.offsets.resize(count + 1);
  for (size_t p = 0; p <= count; ++p) {
    const uint64_t offset = host.offsets ? host.offsets[p] : uint64_t{3} * p;
    if (offset > UINT32_MAX || (p == 0 && offset != 0) ||
        (p > 0 && offset < polygons.offsets[p - 1]))
      fail(ANIC_E_ARGUMENT, "the offsets of polygons must begin with 0 and ascend: number " +
                                std::to_string(p) + " is " + std::to_string(offset));
    polygons.offsets[p] = static_cast<uint32_t>(offset);
  }
  polygons.corners.assign(host.corners, host.corners + polygons.offsets.back());
  for (size_t p = 0; p < count; ++p) {
    for (uint32_t v : polygons[p]) {
      if (v >= host.vertex_count)
        fail(ANIC_E_INDEX_RANGE, "face " + std::to_string(p) + " uses vertex " + std::to_string(v) +
                                     " of " + std::to_string(host.vertex_count));
    }
  }
  return polygons;
}

std::vector<FrameRun> runs_of(const anic_source_mesh& host, uint32_t clip_frames) {
  if (!host.runs)
    return {{0, clip_frames}};
  std::vector<FrameRun> runs;
  uint64_t end = 0;
  for (uint32_t r = 0; r < host.run_count; ++r) {
    const anic_frame_run& run = host.runs[r];
    if (run.count == 0 || run.first < end || uint64_t{run.first} + run.count > clip_frames)
      fail(ANIC_E_ARGUMENT, "the runs of frames must ascend and lie in the clip: number " +
                                std::to_string(r) + " does not");
    end = uint64_t{run.first} + run.count;
    if (!runs.empty() && runs.back().first + runs.back().count == run.first)
      runs.back().count += run.count;
    else
      runs.push_back({run.first, run.count});
  }
  if (runs.empty())
    fail(ANIC_E_ARGUMENT, "no frame shows the mesh");
  return runs;
}

template <class Scalar>
void copy_frame(const unsigned char* from, ptrdiff_t stride, const Point& origin,
                std::span<float> to) {
  for (size_t i = 0; i < to.size(); i += 3, from += stride) {
    Scalar point[3];
    std::memcpy(point, from, sizeof point);
    for (size_t c = 0; c < 3; ++c)
      to[i + c] = static_cast<float>(static_cast<double>(point[c]) - origin[c]);
  }
}

size_t elements_of(const anic_source_attribute& host, const MeshSequence& mesh) {
  switch (host.domain) {
    case ANIC_DOMAIN_VERTICES:
      return mesh.vertex_count;
    case ANIC_DOMAIN_CORNERS:
      return mesh.polygons.corners.size();
    case ANIC_DOMAIN_POLYGONS:
      return mesh.polygons.size();
  }
  fail(ANIC_E_ARGUMENT, "an attribute is of vertices, corners or polygons");
}

PolygonLabels polygon_labels(const anic_source_attribute& host, size_t count) {
  PolygonLabels result;
  for (uint32_t i = 0; i < host.label_count; ++i)
    result.names.push_back(text_of(host.label_names ? host.label_names[i] : nullptr));
  result.of_polygon.reserve(count);
  for (size_t p = 0; p < count; ++p) {
    if (host.labels[p] > host.label_count)
      fail(ANIC_E_ARGUMENT, "polygon " + std::to_string(p) + " has label " +
                                std::to_string(host.labels[p]) + " of " +
                                std::to_string(host.label_count));
    result.of_polygon.push_back(host.labels[p] == 0 ? kNoLabel : host.labels[p] - 1);
  }
  return result;
}

/// Throws for numbers that are not finite or below 0.
MaterialLook look_of(const anic_material* host) {
  MaterialLook look;
  if (!host)
    return look;
  anic_material m = ANIC_INIT(anic_material);
  if (!take(host, &m))
    fail(ANIC_E_ARGUMENT, "a material's struct_size is not set, or of a later version");
  if (m.alpha < ANIC_ALPHA_OPAQUE || m.alpha > ANIC_ALPHA_BLEND)
    fail(ANIC_E_ARGUMENT, "alpha of a material is none of ANIC_ALPHA");
  look.known = true;
  std::copy_n(m.base_colour, 4, look.base_colour.begin());
  look.metallic = m.metallic;
  look.roughness = m.roughness;
  std::copy_n(m.emissive, 3, look.emissive.begin());
  look.alpha = static_cast<AlphaMode>(m.alpha);
  look.alpha_cutoff = m.alpha_cutoff;
  look.double_sided = m.double_sided != 0;
  const char* textures[kTextureSlots] = {m.base_colour_texture, m.metallic_roughness_texture,
                                         m.normal_texture, m.occlusion_texture, m.emissive_texture};
  for (size_t i = 0; i < kTextureSlots; ++i)
    look.textures[i] = textures[i] ? textures[i] : "";
  if (!look.in_range())
    fail(ANIC_E_ARGUMENT, "a number of a material is not finite or below 0");
  return look;
}

void take_labels(const anic_source_attribute& host, size_t count, MeshSequence* mesh) {
  if (!host.labels && count > 0)
    fail(ANIC_E_ARGUMENT, "an attribute without components has labels");
  const bool polygons = host.domain == ANIC_DOMAIN_POLYGONS;
  if (polygons && host.kind == ANIC_ATTRIBUTE_MATERIAL) {
    mesh->materials = polygon_labels(host, count);
    for (uint32_t i = 0; host.materials && i < host.label_count; ++i)
      mesh->materials.looks.push_back(look_of(host.materials[i]));
  } else if (polygons && host.kind == ANIC_ATTRIBUTE_PART)
    mesh->parts = polygon_labels(host, count);
  else if (host.domain == ANIC_DOMAIN_CORNERS && host.kind == ANIC_ATTRIBUTE_NORMAL)
    mesh->shared_normals.assign(host.labels, host.labels + count);
  else
    fail(ANIC_E_ARGUMENT,
         "labels are materials or parts of polygons, or tell which corners share a normal");
}

/// Whether a kind of values has this many components.
bool fits(anic_attribute_kind kind, uint32_t components) {
  switch (kind) {
    case ANIC_ATTRIBUTE_UV:
      return components == 2;
    case ANIC_ATTRIBUTE_NORMAL:
      return components == 3;
    case ANIC_ATTRIBUTE_TANGENT:
      return components == 4;
    case ANIC_ATTRIBUTE_COLOUR:
      return components == 3 || components == 4;
    case ANIC_ATTRIBUTE_CUSTOM:
      return components <= 16;
    case ANIC_ATTRIBUTE_MATERIAL:
    case ANIC_ATTRIBUTE_PART:
      break;
  }
  return false;
}

/// Its own bound, if it has one.
std::optional<AttributeBound> bound_of(const anic_source_attribute& host) {
  using Measure = AttributeBound::Measure;
  switch (host.bound) {
    case ANIC_BOUND_USUAL:
      return std::nullopt;
    case ANIC_BOUND_EXACT:
      return AttributeBound{Measure::kExact};
    case ANIC_BOUND_UNITS:
    case ANIC_BOUND_PERCENT:
      if (!(std::isfinite(host.error) && host.error > 0))
        fail(ANIC_E_ARGUMENT,
             text_of(host.name) + ": the largest error must be finite and greater than 0");
      return AttributeBound{host.bound == ANIC_BOUND_UNITS ? Measure::kUnits : Measure::kPercent,
                            host.error};
  }
  fail(ANIC_E_ARGUMENT, text_of(host.name) + ": the bound is none of ANIC_BOUND");
}

}  // namespace

SourceMesh take_mesh(const anic_source_mesh& host, uint32_t clip_frames) {
  if (clip_frames == 0 && (host.positions || host.read || host.runs))
    fail(ANIC_E_ARGUMENT,
         "the frames of a live clip are pushed: its mesh has no positions and no runs");
  if (clip_frames > 0 && !host.positions == !host.read)
    fail(ANIC_E_ARGUMENT, "a mesh has either positions or a callback that reads them");
  if (host.scalar != ANIC_SCALAR_FLOAT32 && host.scalar != ANIC_SCALAR_FLOAT64)
    fail(ANIC_E_ARGUMENT, "positions are float32 or float64");
  if (host.vertex_count == 0)
    fail(ANIC_E_ARGUMENT, "the mesh has no vertex");
  SourceMesh result;
  result.host = host;
  if (host.vertex_stride == 0)
    result.host.vertex_stride =
        host.scalar == ANIC_SCALAR_FLOAT64 ? 3 * sizeof(double) : 3 * sizeof(float);
  if (host.frame_stride == 0)
    result.host.frame_stride =
        result.host.vertex_stride * static_cast<ptrdiff_t>(host.vertex_count);
  if (clip_frames > 0)
    result.mesh.present_in = runs_of(host, clip_frames);
  MeshSequence& mesh = result.mesh.sequence;
  mesh.mesh_name = text_of(host.name);
  mesh.vertex_count = host.vertex_count;
  for (const FrameRun& run : result.mesh.present_in)
    mesh.frame_count += run.count;
  mesh.polygons = polygons_of(host);
  return result;
}

void take_attribute(const anic_source_attribute& host, MeshSequence* mesh) {
  const size_t elements = elements_of(host, *mesh);
  if (host.components == 0)
    return take_labels(host, elements, mesh);
  if (!fits(host.kind, host.components))
    fail(ANIC_E_ARGUMENT, text_of(host.name) + ": its kind has no attribute of " +
                              std::to_string(host.components) + " components");
  const uint32_t frames = std::max<uint32_t>(host.frames, 1);
  const bool is_pushed = mesh->frame_count == 0 && !host.values;
  if (is_pushed && (host.kind == ANIC_ATTRIBUTE_NORMAL || host.kind == ANIC_ATTRIBUTE_TANGENT))
    fail(ANIC_E_ARGUMENT,
         text_of(host.name) + ": normals and tangents do not move, they follow from the positions");
  if (frames != 1 && frames != mesh->frame_count)
    fail(ANIC_E_ARGUMENT, text_of(host.name) + ": has values for " + std::to_string(frames) +
                              " of " + std::to_string(mesh->frame_count) + " frames");
  if (!host.values && elements > 0 && !is_pushed)
    fail(ANIC_E_ARGUMENT, text_of(host.name) + ": has no values");
  Attribute attribute;
  attribute.kind = static_cast<AttributeKind>(host.kind);
  attribute.name = text_of(host.name);
  attribute.domain = static_cast<AttributeDomain>(host.domain);
  attribute.components = host.components;
  attribute.frames = is_pushed ? 0 : frames;
  attribute.bound = bound_of(host);
  attribute.unit = text_of(host.unit);
  if (host.values)
    attribute.values.assign(host.values, host.values + elements * host.components * frames);
  mesh->attributes.push_back(std::move(attribute));
}

void copy_positions(const void* positions, ptrdiff_t stride, anic_scalar scalar,
                    const Point& origin, std::span<float> to) {
  const auto* from = static_cast<const unsigned char*>(positions);
  if (scalar == ANIC_SCALAR_FLOAT64)
    copy_frame<double>(from, stride, origin, to);
  else if (stride == ptrdiff_t{3 * sizeof(float)} && origin == Point())
    std::memcpy(to.data(), from, to.size_bytes());
  else
    copy_frame<float>(from, stride, origin, to);
}

void read_positions(const SourceMesh& source, const std::function<void(uint32_t)>& before_frame,
                    MeshSequence* mesh) {
  mesh->positions.resize(size_t{mesh->frame_count} * mesh->vertex_count * 3);
  uint32_t number = 0;
  for (const FrameRun& run : source.mesh.present_in) {
    for (uint32_t f = run.first; f < run.first + run.count; ++f, ++number) {
      before_frame(number);
      const std::span<float> to = mesh->frame(number);
      if (!source.host.read)
        copy_positions(static_cast<const unsigned char*>(source.host.positions) +
                           static_cast<ptrdiff_t>(number) * source.host.frame_stride,
                       source.host.vertex_stride, source.host.scalar, mesh->origin, to);
      else if (source.host.read(source.host.user, number, to.data()) != 0)
        fail(ANIC_E_READ, "frame " + std::to_string(f) + ": the callback gave no positions");
      const auto bad = std::ranges::find_if(to, [](float x) { return !std::isfinite(x); });
      if (bad != to.end())
        fail(ANIC_E_NON_FINITE, "frame " + std::to_string(f) + ", vertex " +
                                    std::to_string((bad - to.begin()) / 3) +
                                    ": the position is not finite");
    }
  }
}

}  // namespace anicodec
