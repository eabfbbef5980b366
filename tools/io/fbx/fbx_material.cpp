// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/fbx/fbx_material.h"

#include "tools/io/base/shininess.h"

#include <algorithm>

namespace anicodec::tools {
namespace {

float number_of(const ufbx_material_map& map, float otherwise) {
  return map.has_value ? static_cast<float>(map.value_real) : otherwise;
}

/// The path of an image as the file has it.
String texture_of(const ufbx_material_map& map) {
  const ufbx_texture* texture = map.texture;
  if (texture != nullptr && texture->file_textures.count > 0)  // of layers and shaders the first
    texture = texture->file_textures.data[0];
  if (texture == nullptr || !map.texture_enabled)
    return {};
  const ufbx_string name =
      texture->relative_filename.length > 0 ? texture->relative_filename : texture->filename;
  String text(name.data, name.length);
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

/// The first of two that is there.
String texture_of(const ufbx_material_map& first, const ufbx_material_map& second) {
  String text = texture_of(first);
  return text.empty() ? texture_of(second) : text;
}

}  // namespace

MaterialLook look_of(const ufbx_material& material) {
  MaterialLook look;
  look.known = true;
  const ufbx_material_pbr_maps& pbr = material.pbr;
  const ufbx_material_fbx_maps& fbx = material.fbx;
  const bool is_pbr = pbr.base_color.has_value;
  const ufbx_material_map& base = is_pbr ? pbr.base_color : fbx.diffuse_color;
  const float factor = number_of(is_pbr ? pbr.base_factor : fbx.diffuse_factor, 1);
  if (base.has_value)
    look.base_colour = {static_cast<float>(base.value_vec3.x) * factor,
                        static_cast<float>(base.value_vec3.y) * factor,
                        static_cast<float>(base.value_vec3.z) * factor, 1};
  if (pbr.opacity.has_value)
    look.base_colour[3] = static_cast<float>(
        pbr.opacity.value_components > 1
            ? (pbr.opacity.value_vec3.x + pbr.opacity.value_vec3.y + pbr.opacity.value_vec3.z) / 3
            : pbr.opacity.value_real);
  if (look.base_colour[3] < 1)
    look.alpha = AlphaMode::kBlend;
  look.metallic = number_of(pbr.metalness, 0);
  if (pbr.roughness.has_value)
    look.roughness = static_cast<float>(pbr.roughness.value_real);
  else if (fbx.specular_exponent.has_value)
    look.roughness = roughness_of_shininess(static_cast<float>(fbx.specular_exponent.value_real));
  const ufbx_material_map& emission =
      pbr.emission_color.has_value ? pbr.emission_color : fbx.emission_color;
  const float glow =
      number_of(pbr.emission_color.has_value ? pbr.emission_factor : fbx.emission_factor, 1);
  if (emission.has_value)
    look.emissive = {static_cast<float>(emission.value_vec3.x) * glow,
                     static_cast<float>(emission.value_vec3.y) * glow,
                     static_cast<float>(emission.value_vec3.z) * glow};
  look.double_sided = material.features.double_sided.enabled;
  look.texture(TextureSlot::kBaseColour) = texture_of(pbr.base_color, fbx.diffuse_color);
  look.texture(TextureSlot::kMetallicRoughness) = texture_of(pbr.metalness, pbr.roughness);
  look.texture(TextureSlot::kNormal) = texture_of(pbr.normal_map, fbx.normal_map);
  look.texture(TextureSlot::kOcclusion) = texture_of(pbr.ambient_occlusion);
  look.texture(TextureSlot::kEmissive) = texture_of(pbr.emission_color, fbx.emission_color);
  return look.in_range() ? look : MaterialLook();
}

}  // namespace anicodec::tools
