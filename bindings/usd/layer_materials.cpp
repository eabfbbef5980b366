// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Materials of a layer: UsdPreviewSurface, with UsdUVTexture for images by their names.
#include "bindings/usd/layer_builder.h"

#include <initializer_list>
#include <sstream>
#include <utility>

#include <pxr/gf/vec3f.h>
#include <pxr/gf/vec4f.h>
#include <pxr/sdf/assetPath.h>
#include <pxr/sdf/listOp.h>
#include <pxr/sdf/types.h>
#include <pxr/tf/unicodeUtils.h>

namespace anicodec::usd {

using pxr::SdfPath;
using pxr::TfToken;
using pxr::VtValue;

namespace {

/// OpenUSD takes neither bytes that are not UTF-8 nor control characters in a path: replacement characters stand for them.
pxr::SdfAssetPath asset_path(const char* text) {
  std::ostringstream path;
  for (const pxr::TfUtf8CodePoint point : pxr::TfUtf8CodePointView(text)) {
    const uint32_t code = point.AsUInt32();
    const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    path << (control ? pxr::TfUtf8CodePoint() : point);
  }
  return pxr::SdfAssetPath(path.str());
}

}  // namespace

SdfPath LayerBuilder::material(const std::string& name, uint32_t mesh, uint32_t attribute,
                               uint32_t label) {
  // Files of scenes have a material once for each mesh: prims of one name below a root are one.
  const SdfPath root = prims_[mesh].GetPrefixes().front();
  SdfPath& found = materials_[root.GetString() + " " + name];
  if (!found.IsEmpty())
    return found;
  SdfPath& scope = materials_[root.GetString()];
  if (scope.IsEmpty()) {
    scope = unique(root, "materials");
    ensure_prim(scope, pxr::SdfSpecifierDef, "Scope");
  }
  found = unique(scope, identifier(name));
  ensure_prim(found, pxr::SdfSpecifierDef, "Material");
  anic_material look = ANIC_INIT(anic_material);
  if (!file_->asset().material(attribute, label, &look, mesh))
    return found;
  add_surface(found, look, mesh);
  return found;
}

SdfPath LayerBuilder::add_shader(const SdfPath& path, const char* id) {
  ensure_prim(path, pxr::SdfSpecifierDef, "Shader");
  layer_.set_field(add_property(path, "info:id", "token", true), "default", token(id));
  return path;
}

void LayerBuilder::add_input(const SdfPath& shader, const char* name, const char* type,
                             VtValue value) {
  layer_.set_field(add_property(shader, std::string("inputs:") + name, type), "default",
                   std::move(value));
}

void LayerBuilder::connect(const SdfPath& property, const char* type, const SdfPath& source,
                           const char* output) {
  if (!layer_.has_spec(property))
    add_property(property.GetPrimPath(), property.GetName(), type);
  pxr::SdfPathListOp sources;
  sources.SetExplicitItems({source.AppendProperty(TfToken(std::string("outputs:") + output))});
  layer_.set_field(property, "connectionPaths", VtValue(sources));
}

void LayerBuilder::add_surface(const SdfPath& material, const anic_material& look, uint32_t mesh) {
  const SdfPath shader = add_shader(material.AppendChild(TfToken("surface")), "UsdPreviewSurface");
  const pxr::GfVec4f colour(look.base_colour);
  const pxr::GfVec3f emissive(look.emissive);
  const bool is_opaque = look.alpha == ANIC_ALPHA_OPAQUE;
  // A value beside a connection is what programs without textures show.
  add_input(shader, "diffuseColor", "color3f", VtValue(pxr::GfVec3f(look.base_colour)));
  add_input(shader, "metallic", "float", VtValue(look.metallic));
  add_input(shader, "roughness", "float", VtValue(look.roughness));
  add_input(shader, "emissiveColor", "color3f", VtValue(emissive));
  if (!is_opaque)
    add_input(shader, "opacity", "float", VtValue(colour[3]));
  if (look.alpha == ANIC_ALPHA_MASK)
    add_input(shader, "opacityThreshold", "float", VtValue(look.alpha_cutoff));

  struct Link {
    const char* input;
    const char* type;
    const char* output;
  };

  const SdfPath reader = material.AppendChild(TfToken("st"));
  const auto textured = [&](const char* name, const char* file, const pxr::GfVec4f& scale, bool raw,
                            std::initializer_list<Link> links) {
    if (file == nullptr || *file == 0)
      return;
    if (!layer_.has_spec(reader)) {
      add_shader(reader, "UsdPrimvarReader_float2");
      add_input(reader, "varname", "string", VtValue(uv_name(mesh)));
      add_property(reader, "outputs:result", "float2");
    }
    const SdfPath texture = add_shader(material.AppendChild(TfToken(name)), "UsdUVTexture");
    add_input(texture, "file", "asset", VtValue(asset_path(file)));
    connect(texture.AppendProperty(TfToken("inputs:st")), "float2", reader, "result");
    add_input(texture, "scale", "float4", VtValue(scale));
    add_input(texture, "sourceColorSpace", "token", token(raw ? "raw" : "sRGB"));
    if (std::string(name) == "normalTexture")  // from 0..1 to -1..1
      add_input(texture, "bias", "float4", VtValue(pxr::GfVec4f(-1, -1, -1, 0)));
    for (const Link& link : links) {
      add_property(texture, std::string("outputs:") + link.output,
                   std::string(link.output) == "rgb" ? "float3" : "float");
      connect(shader.AppendProperty(TfToken(std::string("inputs:") + link.input)), link.type,
              texture, link.output);
    }
  };
  const Link diffuse = {"diffuseColor", "color3f", "rgb"};
  if (is_opaque)
    textured("baseColourTexture", look.base_colour_texture, colour, false, {diffuse});
  else
    textured("baseColourTexture", look.base_colour_texture, colour, false,
             {diffuse, {"opacity", "float", "a"}});
  textured("metallicRoughnessTexture", look.metallic_roughness_texture,
           {1, look.roughness, look.metallic, 1}, true,
           {{"roughness", "float", "g"}, {"metallic", "float", "b"}});
  textured("normalTexture", look.normal_texture, {2, 2, 2, 1}, true,
           {{"normal", "normal3f", "rgb"}});
  textured("occlusionTexture", look.occlusion_texture, pxr::GfVec4f(1), true,
           {{"occlusion", "float", "r"}});
  textured("emissiveTexture", look.emissive_texture, {emissive[0], emissive[1], emissive[2], 1},
           false, {{"emissiveColor", "color3f", "rgb"}});
  add_property(shader, "outputs:surface", "token");
  connect(material.AppendProperty(TfToken("outputs:surface")), "token", shader, "surface");
}

std::string LayerBuilder::uv_name(uint32_t mesh) const {
  for (uint32_t number = 0; number < file_->asset().mesh(mesh).attribute_count; ++number) {
    const anic_attribute attribute = file_->asset().attribute(number, mesh);
    if (attribute.kind == ANIC_ATTRIBUTE_UV && attribute.name[0] != 0)
      return identifier(attribute.name);
  }
  return "st";
}

}  // namespace anicodec::usd
