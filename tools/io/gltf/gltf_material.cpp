// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_material.h"

#include "tools/io/gltf/gltf_container.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace anicodec::tools {
namespace {

using Json = nlohmann::json;

constexpr std::array<const char*, 3> kAlphaModes = {"OPAQUE", "MASK", "BLEND"};
constexpr const char* kStrength = "KHR_materials_emissive_strength";
constexpr const char* kTransform = "KHR_texture_transform";

/// The slots, and where they stand in a material.
struct SlotPlace {
  TextureSlot slot;
  const char* object;  ///< null: the material itself
  const char* key;
};

constexpr const char* kMetallicRoughness = "pbrMetallicRoughness";
constexpr SlotPlace kSlots[] = {
    {TextureSlot::kBaseColour, kMetallicRoughness, "baseColorTexture"},
    {TextureSlot::kMetallicRoughness, kMetallicRoughness, "metallicRoughnessTexture"},
    {TextureSlot::kNormal, nullptr, "normalTexture"},
    {TextureSlot::kOcclusion, nullptr, "occlusionTexture"},
    {TextureSlot::kEmissive, nullptr, "emissiveTexture"}};

float number_or(const std::optional<JsonNode>& node, const char* key, double otherwise) {
  const std::optional<JsonNode> found = node ? node->find(key) : std::nullopt;
  return static_cast<float>(std::max(0.0, found ? found->number() : otherwise));
}

template <size_t count>
void read_colour(const std::optional<JsonNode>& node, const char* key,
                 std::array<float, count>& colour) {
  const std::optional<JsonNode> found = node ? node->find(key) : std::nullopt;
  if (!found)
    return;
  const std::vector<double> numbers = found->numbers(count);
  for (size_t i = 0; i < count; ++i)
    colour[i] = static_cast<float>(std::max(0.0, numbers[i]));
}

/// The name that a look gives the image of each texture.
std::vector<std::string> image_names(const JsonNode& root) {
  std::vector<std::string> images, textures;
  for (const JsonNode& node : root.elements("images")) {
    images.push_back(is_inside(node) ? name_inside(node, images.size())
                                     : decoded_uri(node.member("uri").text()));
  }
  for (const JsonNode& node : root.elements("textures")) {
    std::optional<JsonNode> source = node.find("source");
    if (const std::optional<JsonNode> extensions = node.find("extensions"); extensions && !source) {
      for (const auto& [name, extension] : extensions->members()) {  // other formats of images
        if (!source)
          source = extension.find("source");
      }
    }
    textures.push_back(source ? images[source->index(images.size(), "images")] : "");
  }
  return textures;
}

class MaterialReader {
 public:
  MaterialReader(const JsonNode& root, LeftKinds* left_out)
      : textures_(image_names(root)), left_out_(left_out) {}

  GltfMaterial read(const JsonNode& node) {
    GltfMaterial material;
    material.name = text_or_empty(node, "name");
    MaterialLook& look = material.look;
    look.known = true;
    const std::optional<JsonNode> surface = node.find(kMetallicRoughness);
    read_colour(surface, "baseColorFactor", look.base_colour);
    look.metallic = number_or(surface, "metallicFactor", 1);
    look.roughness = number_or(surface, "roughnessFactor", 1);
    read_colour(std::optional(node), "emissiveFactor", look.emissive);
    look.alpha_cutoff = number_or(std::optional(node), "alphaCutoff", 0.5);
    if (const std::optional<JsonNode> sided = node.find("doubleSided"))
      look.double_sided = sided->boolean();
    const std::string mode = text_or_empty(node, "alphaMode");
    for (size_t i = 0; i < kAlphaModes.size(); ++i) {
      if (mode == kAlphaModes[i])
        look.alpha = static_cast<AlphaMode>(i);
    }
    for (const SlotPlace& place : kSlots) {
      const std::optional<JsonNode> object = place.object ? surface : std::optional(node);
      const std::optional<JsonNode> texture = object ? object->find(place.key) : std::nullopt;
      if (texture)
        read_texture(*texture, look.texture(place.slot), &material.transforms);
    }
    std::erase_if(material.transforms,
                  [](const auto& of) { return of.second == TextureTransform(); });
    read_extensions(node, look);
    return material;
  }

 private:
  void read_texture(const JsonNode& node, String& texture,
                    std::map<uint32_t, TextureTransform>* transforms) {
    texture = textures_.empty()
                  ? ""
                  : textures_[node.member("index").index(textures_.size(), "textures")].c_str();
    uint32_t set = set_of(node, 0);
    TextureTransform transform;
    const std::optional<JsonNode> extensions = node.find("extensions");
    if (const auto moved = extensions ? extensions->find(kTransform) : std::nullopt) {
      set = set_of(*moved, set);
      transform = read_transform(*moved);
    }
    if (set != 0)
      left_out_->add("that a texture uses other texture coordinates than the first");
    if (transforms->try_emplace(set, transform).first->second != transform)
      left_out_->add("that textures of a material move texture coordinates in different ways");
  }

  static uint32_t set_of(const JsonNode& node, uint32_t otherwise) {
    const std::optional<JsonNode> set = node.find("texCoord");
    return set ? static_cast<uint32_t>(set->whole(UINT32_MAX)) : otherwise;
  }

  /// Scales, turns, then moves; v points down, in which a turn is counter-clockwise.
  static TextureTransform read_transform(const JsonNode& node) {
    const auto pair = [&node](const char* key, double otherwise) {
      const std::optional<JsonNode> found = node.find(key);
      return found ? found->numbers(2) : std::vector<double>{otherwise, otherwise};
    };
    const std::vector<double> offset = pair("offset", 0), scale = pair("scale", 1);
    const std::optional<JsonNode> rotation = node.find("rotation");
    const double angle = rotation ? rotation->number() : 0;
    const double c = std::cos(angle), s = std::sin(angle);
    return {{c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]}};
  }

  void read_extensions(const JsonNode& node, MaterialLook& look) {
    const std::optional<JsonNode> extensions = node.find("extensions");
    const std::optional<JsonNode> strength =
        extensions ? extensions->find(kStrength) : std::nullopt;
    const float factor = number_or(strength, "emissiveStrength", 1);
    for (float& x : look.emissive)
      x *= factor;
  }

  std::vector<std::string> textures_;
  LeftKinds* left_out_;
};

}  // namespace

std::vector<GltfMaterial> read_materials(const JsonNode& root, LeftKinds* left_out) {
  MaterialReader reader(root, left_out);
  std::vector<GltfMaterial> materials;
  for (const JsonNode& node : root.elements("materials"))
    materials.push_back(reader.read(node));
  return materials;
}

bool is_inside(const JsonNode& image) {
  const std::optional<JsonNode> uri = image.find("uri");
  return !uri || is_data_uri(uri->text());
}

std::string name_inside(const JsonNode& image, size_t number) {
  const std::string name = text_or_empty(image, "name");
  return "#" + (name.empty() ? std::to_string(number) : name);
}

bool is_inside_document(const String& texture) {
  return !texture.empty() && texture[0] == '#';
}

std::optional<size_t> GltfMaterials::texture_of(const String& image) {
  if (const auto found = known_.find(image); found != known_.end())
    return found->second;
  const std::string text(image.begin(), image.end());
  if (!is_inside_document(image)) {
    images_.push_back({{"uri", encoded_uri(text)}});
  } else if (wanted_ == GltfTextures::kAll) {
    images_.push_back({{"name", text.substr(1)}});
  } else {
    const auto inside = std::ranges::find(inside_, text, &GltfImage::name);
    if (inside == inside_.end())
      return {};
    images_.push_back({{"name", text.substr(1)},
                       {"mimeType", inside->type},
                       {"bufferView", add_image_(inside->bytes)}});
  }
  known_.emplace(image, images_.size() - 1);
  return images_.size() - 1;
}

void GltfMaterials::add(const std::string& name, const MaterialLook& look) {
  Json& json = materials_.emplace_back();
  json = {{"name", name}};
  Json& surface = json[kMetallicRoughness];
  surface = {{"metallicFactor", look.metallic}, {"roughnessFactor", look.roughness}};
  if (!look.known)
    return;
  surface["baseColorFactor"] = look.base_colour;
  if (const float most = std::ranges::max(look.emissive); most > 0) {
    std::array<float, 3> colour = look.emissive;
    if (most > 1) {
      for (float& x : colour)
        x /= most;
      json["extensions"][kStrength]["emissiveStrength"] = most;
      has_strength_ = true;
    }
    json["emissiveFactor"] = colour;
  }
  if (look.alpha != AlphaMode::kOpaque)
    json["alphaMode"] = kAlphaModes[static_cast<size_t>(look.alpha)];
  if (look.alpha == AlphaMode::kMask)
    json["alphaCutoff"] = look.alpha_cutoff;
  if (look.double_sided)
    json["doubleSided"] = true;
  for (const SlotPlace& place : kSlots) {
    const String& image = look.texture(place.slot);
    if (image.empty() || wanted_ == GltfTextures::kNone)
      continue;
    if (const std::optional<size_t> texture = texture_of(image)) {
      Json& object = place.object ? json[place.object] : json;
      object[place.key] = {{"index", *texture}};
    }
  }
}

}  // namespace anicodec::tools
