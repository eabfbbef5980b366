// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/poly_mesh_output.h"

#include "tools/io/alembic/abc_names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr const char* kPolyMesh =
    "schema=AbcGeom_PolyMesh_v1;schemaBaseType=AbcGeom_GeomBase_v1;"
    "schemaObjTitle=AbcGeom_PolyMesh_v1:.geom";
constexpr const char* kFaceSet =
    "schema=AbcGeom_FaceSet_v1;schemaBaseType=AbcGeom_GeomBase_v1;"
    "schemaObjTitle=AbcGeom_FaceSet_v1:.faceset";
constexpr const char* kBox = "interpretation=box";

constexpr size_t kNoLook = SIZE_MAX - 1;  ///< of a frame that shows nothing

using Box = std::array<double, 6>;

Box empty_box() {
  constexpr double kFar = std::numeric_limits<double>::max();
  return {kFar, kFar, kFar, -kFar, -kFar, -kFar};
}

Box box_of(std::span<const float> positions) {
  Box box = empty_box();
  for (size_t i = 0; i < positions.size(); ++i) {
    const auto x = static_cast<double>(positions[i]);
    box[i % 3] = std::min(box[i % 3], x);
    box[3 + i % 3] = std::max(box[3 + i % 3], x);
  }
  return box;
}

PartMembers all_of(const MeshSequence& mesh) {
  PartMembers members;
  members.vertices.resize(mesh.vertex_count);
  members.polygons.resize(mesh.polygons.size());
  members.corners.resize(mesh.polygons.corners.size());
  for (std::vector<uint32_t>* list : {&members.vertices, &members.polygons, &members.corners})
    std::iota(list->begin(), list->end(), 0U);
  return members;
}

std::vector<float> taken(std::span<const float> values, const std::vector<uint32_t>& rows,
                         size_t components) {
  std::vector<float> out;
  out.reserve(rows.size() * components);
  for (uint32_t row : rows) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * components);
    out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(components));
  }
  return out;
}

/// The interpretation of numbers in an archive, empty for plain ones.
std::string meaning_of(AttributeKind kind, uint32_t components) {
  if (kind == AttributeKind::kColour)
    return components == 4 ? "rgba" : "rgb";
  if (kind == AttributeKind::kNormal)
    return "normal";
  return kind == AttributeKind::kUv || components == 2 || components == 3 ? "vector" : "";
}

/// Metadata of values beside the positions.
std::string param_metadata(AttributeKind kind, uint32_t components, bool per_corner,
                           const std::string& source_name) {
  const std::string meaning = meaning_of(kind, components);
  std::string out = "arrayExtent=1;geoScope=";
  out += per_corner ? "fvr" : "vtx";
  if (!meaning.empty())
    out += ";interpretation=" + meaning;
  out += ";isGeomParam=true";
  if (kind == AttributeKind::kCustom && components == 2)
    out += ";notUV=1";
  out += ";podExtent=" + std::to_string(components) + ";podName=float32_t";
  if (!source_name.empty())
    out += ";sourceName=" + source_name;
  return out;
}

/// Whether an archive can have the attribute.
bool is_written(const Attribute& attribute) {
  if (attribute.domain == AttributeDomain::kPolygon)
    return false;
  switch (attribute.kind) {
    case AttributeKind::kUv:
      return attribute.components == 2;
    case AttributeKind::kColour:
      return attribute.components == 3 || attribute.components == 4;
    case AttributeKind::kCustom:
      return attribute.per_vertex() && attribute.components > 0;
    default:
      return false;
  }
}

/// Values of corners as an archive has texture coordinates: those that the corners at one vertex
/// share once, so that neighbours stay connected.
struct Indexed {
  std::vector<float> values;
  std::vector<uint32_t> indices;
};

Indexed indexed(const AbcLook& look, std::span<const float> of_corners, size_t components) {
  Indexed out;
  constexpr uint32_t kNone = UINT32_MAX;
  constexpr int kMostCompared = 64;
  uint32_t spare = kNone;
  std::vector<uint32_t> first(look.vertex_count(), kNone), next;  // lists of values by vertex
  for (size_t c = 0; c < look.face_indices().size(); ++c) {
    const auto value = of_corners.subspan(c * components, components);
    uint32_t* at = &first[static_cast<size_t>(look.face_indices()[c])];
    for (int step = 0; *at != kNone; ++step) {
      if (std::equal(value.begin(), value.end(), &out.values[size_t{*at} * components]))
        break;
      if (step == kMostCompared) {  // the hub of a fan without end: not worth it
        at = &spare;
        spare = kNone;
        break;
      }
      at = &next[*at];
    }
    if (*at == kNone) {
      *at = static_cast<uint32_t>(next.size());
      out.indices.push_back(*at);
      out.values.insert(out.values.end(), value.begin(), value.end());
      next.push_back(kNone);
    } else {
      out.indices.push_back(*at);
    }
  }
  return out;
}

}  // namespace

AbcLook::AbcLook(const MeshSequence& mesh) : AbcLook(mesh, all_of(mesh)) {}

AbcLook::AbcLook(const MeshSequence& mesh, PartMembers members)
    : mesh_(&mesh), members_(std::move(members)) {
  std::vector<int32_t> number(mesh.vertex_count);
  for (size_t v = 0; v < members_.vertices.size(); ++v)
    number[members_.vertices[v]] = static_cast<int32_t>(v);
  members_.corners.clear();
  for (uint32_t p : members_.polygons) {
    const uint32_t begin = mesh.polygons.offsets[p], end = mesh.polygons.offsets[p + 1];
    face_counts_.push_back(static_cast<int32_t>(end - begin));
    for (uint32_t c = end; c-- > begin;) {
      members_.corners.push_back(c);
      face_indices_.push_back(number[mesh.polygons.corners[c]]);
    }
  }
}

std::vector<float> AbcLook::of_vertices(std::span<const float> values, size_t components) const {
  return taken(values, members_.vertices, components);
}

std::vector<float> AbcLook::of_corners(std::span<const float> values, size_t components) const {
  return taken(values, members_.corners, components);
}

std::vector<int32_t> AbcLook::faces_of(const std::string& material) const {
  const PolygonLabels& labels = mesh_->materials;
  std::vector<int32_t> faces;
  if (labels.of_polygon.empty())
    return faces;
  for (size_t p = 0; p < members_.polygons.size(); ++p) {
    const uint32_t label = labels.of_polygon[members_.polygons[p]];
    if (label != kNoLabel && labels.names[label] == material)
      faces.push_back(static_cast<int32_t>(p));
  }
  return faces;
}

PolyMeshOutput::PolyMeshOutput(AbcObjectOutput& parent, std::string name, uint32_t sampling,
                               std::vector<AbcLook> looks, const AbcMeshOptions& options)
    : looks_(std::move(looks)) {
  AbcObjectOutput& object = parent.child(std::move(name), kPolyMesh);
  AbcCompoundOutput& geometry = object.properties().compound(
      ".geom", "schema=AbcGeom_PolyMesh_v1;schemaBaseType=AbcGeom_GeomBase_v1");
  bounds_ = &timed(geometry.scalar(".selfBnds", kBox, AbcType::kFloat64, 6, sampling));
  positions_ = &timed(
      geometry.array("P", "geoScope=vtx;interpretation=point", AbcType::kFloat32, 3, sampling));
  face_indices_ = &timed(geometry.array(".faceIndices", "", AbcType::kInt32, 1, sampling));
  face_counts_ = &timed(geometry.array(".faceCounts", "", AbcType::kInt32, 1, sampling));
  if (options.normals)
    normals_ = &timed(geometry.array("N", param_metadata(AttributeKind::kNormal, 3, true, ""),
                                     AbcType::kFloat32, 3, sampling));
  add_params(geometry, sampling, options.moving);
  if (options.is_hidden)
    visible_ = &object.properties().scalar("visible", "", AbcType::kInt8, 1, sampling);
  add_face_sets(object, sampling);
}

AbcPropertyOutput& PolyMeshOutput::timed(AbcPropertyOutput& property) {
  timed_.push_back(&property);
  return property;
}

/// All values that some look has; what is still and of the only look has one sample.
void PolyMeshOutput::add_params(AbcCompoundOutput& geometry, uint32_t sampling, bool moving) {
  for (const AbcLook& look : looks_) {
    for (const Attribute& attribute : look.mesh().attributes) {
      const auto same = [&](const Param& p) {
        return p.kind == attribute.kind && p.name == attribute.name &&
               p.per_corner == attribute.per_corner() && p.components == attribute.components;
      };
      if (is_written(attribute) && std::ranges::none_of(params_, same))
        params_.push_back({.kind = attribute.kind,
                           .name = attribute.name,
                           .source = attribute.name,
                           .per_corner = attribute.per_corner(),
                           .components = attribute.components,
                           .is_still = looks_.size() == 1 && attribute.frames == 1 && !moving});
    }
  }
  const auto uv =
      std::ranges::find_if(params_, [](const Param& p) { return p.kind == AttributeKind::kUv; });
  if (uv != params_.end())
    create(*uv, true, geometry, sampling);
  if (std::ranges::all_of(params_, [](const Param& p) { return p.values != nullptr; }))
    return;
  AbcCompoundOutput& arbitrary = geometry.compound(".arbGeomParams", "");
  AbcNames names;
  for (Param& param : params_) {
    if (param.values != nullptr)
      continue;
    param.name = names.unique(param.name);
    create(param, false, arbitrary, sampling);
  }
}

void PolyMeshOutput::create(Param& param, bool in_geometry, AbcCompoundOutput& parent,
                            uint32_t sampling) {
  const std::string name = in_geometry ? "uv" : param.name;
  const std::string metadata = param_metadata(param.kind, param.components, param.per_corner,
                                              in_geometry ? metadata_text(param.name) : "");
  const uint32_t own = param.is_still ? 0 : sampling;
  AbcCompoundOutput* compound = &parent;
  if (param.per_corner) {
    compound = &parent.compound(name, metadata);
    param.values = &compound->array(".vals", metadata, AbcType::kFloat32, param.components, own);
    param.indices = &compound->array(".indices", "", AbcType::kUint32, 1, own);
  } else {
    param.values = &parent.array(name, metadata, AbcType::kFloat32, param.components, own);
  }
  if (param.is_still)
    return;
  timed_.push_back(param.values);
  if (param.indices != nullptr)
    timed_.push_back(param.indices);
}

void PolyMeshOutput::add_face_sets(AbcObjectOutput& object, uint32_t sampling) {
  AbcNames names;
  for (const AbcLook& look : looks_) {
    for (const std::string& material : look.mesh().materials.names) {
      if (face_sets_.contains(material) || look.faces_of(material).empty())
        continue;
      AbcObjectOutput& child = object.child(names.unique(material), kFaceSet);
      AbcCompoundOutput& set = child.properties().compound(
          ".faceset", "schema=AbcGeom_FaceSet_v1;schemaBaseType=AbcGeom_GeomBase_v1");
      set.scalar(".selfBnds", kBox, AbcType::kFloat64, 6, 0)
          .add(std::span<const double>(empty_box()));
      AbcPropertyOutput& faces =
          set.array(".faces", "", AbcType::kInt32, 1, looks_.size() == 1 ? 0 : sampling);
      set.scalar(".facesExclusive", "", AbcType::kUint32, 1, 0).add_one(uint32_t{1});
      face_sets_[material] = &faces;
      if (looks_.size() > 1)
        timed_.push_back(&faces);
      else
        faces.add(std::span<const int32_t>(look.faces_of(material)));
    }
  }
}

void PolyMeshOutput::hide() {
  if (visible_ != nullptr)
    visible_->add_one(int8_t{0});
  if (looks_.size() > 1) {  // faces change anyway: also for programs that do not look at `visible`
    for (AbcPropertyOutput* property : timed_) {
      if (property == bounds_)
        property->add(std::span<const double>(empty_box()));
      else
        property->add(std::string_view());
    }
    last_look_ = kNoLook;
    return;
  }
  if (last_look_ == SIZE_MAX) {
    ++hidden_at_start_;
    return;
  }
  for (AbcPropertyOutput* property : timed_)
    property->repeat();
}

void PolyMeshOutput::show_faces(size_t look) {
  if (look == last_look_) {
    face_indices_->repeat();
    face_counts_->repeat();
  } else {
    face_indices_->add(std::span<const int32_t>(looks_[look].face_indices()));
    face_counts_->add(std::span<const int32_t>(looks_[look].face_counts()));
  }
  if (looks_.size() == 1)
    return;
  for (const auto& [material, faces] : face_sets_) {
    if (look == last_look_)
      faces->repeat();
    else
      faces->add(std::span<const int32_t>(looks_[look].faces_of(material)));
  }
}

void PolyMeshOutput::write(Param& param, const AbcLook& look, const AbcSample& sample) {
  if (param.is_still && param.values->samples() > 0)
    return;
  const auto found = std::ranges::find_if(sample.attributes, [&](const Attribute& a) {
    return a.kind == param.kind && a.per_corner() == param.per_corner &&
           a.components == param.components && a.name == param.source;
  });
  std::vector<float> values;
  if (found != sample.attributes.end())
    values = param.per_corner ? look.of_corners(found->values, param.components)
                              : look.of_vertices(found->values, param.components);
  if (param.indices == nullptr)
    return param.values->add(std::span<const float>(values));
  Indexed corners;
  if (!values.empty())
    corners = indexed(look, values, param.components);
  param.values->add(std::span<const float>(corners.values));
  param.indices->add(std::span<const uint32_t>(corners.indices));
}

void PolyMeshOutput::show(size_t look, const AbcSample& sample) {
  const AbcLook& own = looks_[look];
  if (visible_ != nullptr)
    visible_->add_one(int8_t{1});
  const bool whole = own.vertex_count() == own.mesh().vertex_count;
  const std::vector<float> part =
      whole ? std::vector<float>() : own.of_vertices(sample.positions, 3);
  const std::span<const float> positions = whole ? sample.positions : std::span<const float>(part);
  const Box box = box_of(positions);
  bounds_->add(std::span<const double>(box));
  positions_->add(positions);
  show_faces(look);
  if (normals_ != nullptr)
    normals_->add(std::span<const float>(own.of_corners(sample.corner_normals, 3)));
  for (Param& param : params_)
    write(param, own, sample);
  const bool is_first = last_look_ == SIZE_MAX;
  last_look_ = look;
  for (uint32_t f = 0; is_first && f < hidden_at_start_; ++f) {
    for (AbcPropertyOutput* property : timed_)
      property->repeat();
  }
}

}  // namespace anicodec::tools
