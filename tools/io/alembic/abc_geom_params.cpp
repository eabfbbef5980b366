// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_geom_params.h"

#include "format/records.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec::tools {
namespace {

/// The number of values that a scope asks for, else that they have.
AbcDomain domain_of(const AbcGeomParam& param, size_t elements, const Polygons& polygons,
                    uint32_t vertices) {
  const std::pair<AbcDomain, size_t> sizes[] = {{AbcDomain::kCorner, polygons.corners.size()},
                                                {AbcDomain::kVertex, vertices},
                                                {AbcDomain::kFace, polygons.size()},
                                                {AbcDomain::kMesh, 1}};
  const std::string& scope = param.scope;
  const AbcDomain told = scope == "fvr"                     ? AbcDomain::kCorner
                         : scope == "vtx" || scope == "var" ? AbcDomain::kVertex
                         : scope == "uni"                   ? AbcDomain::kFace
                                                            : AbcDomain::kMesh;
  for (const auto& [domain, size] : sizes) {
    if (domain == told && size == elements)
      return domain;
  }
  for (const auto& [domain, size] : sizes) {
    if (size == elements)
      return domain;
  }
  return AbcDomain::kNone;
}

bool is_number(const AbcProperty& property) {
  return property.shape != AbcShape::kCompound && size_of(property.type) > 0;
}

/// Colours of whole numbers have all of their range.
float whole(AbcType type) {
  return type == AbcType::kUint8 ? 255.0F : type == AbcType::kUint16 ? 65535.0F : 1.0F;
}

}  // namespace

AbcGeomParams::AbcGeomParams(const AbcArchive& archive, const AbcObject& object,
                             const AbcCompound& geometry, const AbcNote& note)
    : archive_(archive) {
  if (const AbcProperty* uv = geometry.find("uv")) {
    const std::string_view name = metadata_value(uv->metadata, "sourceName");
    add(AttributeKind::kUv, name.empty() ? "uv" : std::string(name), *uv);
  }
  if (const AbcProperty* normals = geometry.find("N"))
    add(AttributeKind::kNormal, "N", *normals);
  const AbcProperty* arbitrary = geometry.find(".arbGeomParams");
  if (arbitrary == nullptr || arbitrary->shape != AbcShape::kCompound)
    return;
  for (const AbcProperty& property : archive.properties(*arbitrary).properties)
    add_arbitrary(property, [&](const std::string& text) {
      note(object.path + ": '" + property.name + "' " + text);
    });
}

void AbcGeomParams::add(AttributeKind kind, std::string name, const AbcProperty& property) {
  const std::string scope(metadata_value(property.metadata, "geoScope"));
  const AbcProperty* values = &property;
  std::optional<AbcSamples> indices;
  AbcCompound compound;
  if (property.shape == AbcShape::kCompound) {
    compound = archive_.properties(property);
    values = compound.find(".vals");
    const AbcProperty* own = compound.find(".indices");
    if (values == nullptr || own == nullptr)
      archive_.file.fail(property.place(), "has no values or no indices");
    archive_.time_of(*own);
    if (own->samples > 0)
      indices.emplace(archive_.file, *own);
  }
  if (!is_number(*values) || values->samples == 0)
    return;
  const uint32_t expected = kind == AttributeKind::kUv ? 2 : kind == AttributeKind::kNormal ? 3 : 0;
  if (expected != 0 && values->extent != expected)
    archive_.file.fail(values->place(), "has " + std::to_string(values->extent) +
                                            " numbers per element, not " +
                                            std::to_string(expected));
  archive_.time_of(*values);
  params_.push_back(
      {kind, std::move(name), scope, AbcSamples(archive_.file, *values), std::move(indices)});
}

void AbcGeomParams::add_arbitrary(const AbcProperty& property, const AbcNote& note) {
  const bool indexed = property.shape == AbcShape::kCompound;
  const AbcCompound compound = indexed ? archive_.properties(property) : AbcCompound();
  const AbcProperty* values = indexed ? compound.find(".vals") : &property;
  if (values == nullptr || !is_number(*values))
    return note("is left out: it is no number");
  if (values->extent > kMaxAttributeComponents)
    return note("is left out: it has " + std::to_string(values->extent) + " numbers per element");
  const std::string_view told = metadata_value(property.metadata, "interpretation");
  const std::string_view meaning =
      told.empty() ? metadata_value(values->metadata, "interpretation") : told;
  if (meaning.starts_with("rgb") && (values->extent == 3 || values->extent == 4))
    return add(AttributeKind::kColour, property.name, property);
  if (values->extent == 2 && meaning == "vector" &&
      metadata_value(property.metadata, "notUV") != "1")
    return add(AttributeKind::kUv, property.name, property);
  const std::string_view scope = metadata_value(property.metadata, "geoScope");
  if (scope != "vtx" && scope != "var")
    return note("is left out: it has no value for each vertex");
  add(AttributeKind::kCustom, property.name, property);
}

AbcValues AbcGeomParams::values_at(const AbcGeomParam& param, double time, const Polygons& polygons,
                                   uint32_t vertices) const {
  AbcValues out;
  const std::vector<float> values = param.values.floats(archive_.sample_at(param.values, time));
  const size_t n = param.components();
  if (param.indices) {
    const std::vector<int32_t> indices =
        param.indices->integers(archive_.sample_at(*param.indices, time));
    out.domain = domain_of(param, indices.size(), polygons, vertices);
    if (out.domain == AbcDomain::kNone)
      return out;
    out.values.reserve(indices.size() * n);
    for (int32_t signed_index : indices) {
      const auto i = static_cast<uint32_t>(signed_index);
      if (i >= values.size() / n)
        archive_.file.fail(
            param.indices->property().place(),
            "index " + std::to_string(i) + " of " + std::to_string(values.size() / n) + " values");
      out.values.insert(out.values.end(), &values[i * n], &values[i * n] + n);
    }
    return out;
  }
  out.domain = domain_of(param, values.size() / n, polygons, vertices);
  if (out.domain != AbcDomain::kNone)
    out.values.assign(values.begin(), values.end());
  return out;
}

std::optional<Attribute> AbcGeomParams::attribute_at(const AbcGeomParam& param, double time,
                                                     const Polygons& polygons,
                                                     uint32_t vertices) const {
  AbcValues found = values_at(param, time, polygons, vertices);
  if (found.domain == AbcDomain::kNone ||
      !std::ranges::all_of(found.values, [](float x) { return std::isfinite(x); }))
    return std::nullopt;
  if (param.kind == AttributeKind::kCustom && found.domain != AbcDomain::kVertex)
    return std::nullopt;
  Attribute out;
  out.kind = param.kind;
  out.name = param.name;
  out.components = param.components();
  if (found.domain == AbcDomain::kCorner || found.domain == AbcDomain::kFace)
    out.domain = AttributeDomain::kCorner;
  const size_t n = out.components;
  if (found.domain == AbcDomain::kMesh) {
    for (uint32_t v = 0; v < vertices; ++v)
      out.values.insert(out.values.end(), found.values.begin(), found.values.end());
  } else if (found.domain == AbcDomain::kFace) {
    for (size_t p = 0; p < polygons.size(); ++p) {
      for (size_t c = 0; c < polygons[p].size(); ++c)
        out.values.insert(out.values.end(), &found.values[p * n], &found.values[p * n] + n);
    }
  } else {
    out.values = std::move(found.values);
  }
  const float range =
      out.kind == AttributeKind::kColour ? whole(param.values.property().type) : 1.0F;
  if (range != 1.0F) {
    for (float& x : out.values)
      x /= range;
  }
  return out;
}

}  // namespace anicodec::tools
