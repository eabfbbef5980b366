// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_MATERIAL_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_MATERIAL_H_

#include "format/material_look.h"
#include "tools/io/base/left_kinds.h"
#include "tools/io/gltf/json_node.h"

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// KHR_texture_transform: how a texture moves the coordinates that it is looked up at.
struct TextureTransform {
  std::array<double, 6> matrix{1, 0, 0, 0, 1, 0};  ///< rows of 2 x 3

  auto operator<=>(const TextureTransform&) const = default;
};

/// A material of a document.
struct GltfMaterial {
  std::string name;
  MaterialLook look;
  /// The transform of a set of texture coordinates: that of the first texture that uses it.
  std::map<uint32_t, TextureTransform> transforms = {};
};

/// Reads the materials of a document, with the images that they name: an image in a file of its own
/// by its path, one inside the document as "#name", or "#3" by its number. Adds what a look has no place for, of
/// what it looks at. Throws at a node that is not as it should be.
std::vector<GltfMaterial> read_materials(const JsonNode& root, LeftKinds* left_out);

/// Whether the bytes of an image are inside its document.
bool is_inside(const JsonNode& image);

/// How looks name such an image, the `number`-th of the document.
std::string name_inside(const JsonNode& image, size_t number);

/// Whether a look names an image inside a document, of which a file keeps nothing but this name.
bool is_inside_document(const String& texture);

/// An image inside a document.
struct GltfImage {
  std::string name;  ///< as a look names it, "#wood"
  std::string type;  ///< "image/png"
  std::string bytes;
};

/// The images that a document which is written names.
enum class GltfTextures {
  kNone,   ///< where there are no texture coordinates
  kFiles,  ///< those in files of their own, and those that are put inside
  kAll     ///< those inside another document too, by a name alone: not for other readers
};

/// The materials of a document that is written.
class GltfMaterials {
 public:
  /// `add_image` puts the bytes of an image into the document and returns the number of their view.
  explicit GltfMaterials(GltfTextures textures, std::span<const GltfImage> images = {},
                         std::function<size_t(std::string_view bytes)> add_image = {})
      : wanted_(textures), inside_(images), add_image_(std::move(add_image)) {}

  void add(const std::string& name, const MaterialLook& look);

  /// Puts "materials", and "textures" and "images" where there are some, into the document.
  template <class Json>
  void describe_in(Json& document) const {
    if (!materials_.empty())
      document["materials"] = materials_;
    if (has_strength_)
      document["extensionsUsed"] = Json::array({"KHR_materials_emissive_strength"});
    if (!images_.empty())
      document["images"] = images_;
    for (size_t i = 0; i < images_.size(); ++i)
      document["textures"].push_back({{"source", i}});
  }

 private:
  /// Nothing where the document cannot have it.
  std::optional<size_t> texture_of(const String& image);

  GltfTextures wanted_;
  std::span<const GltfImage> inside_;
  std::function<size_t(std::string_view)> add_image_;
  nlohmann::json materials_ = nlohmann::json::array(), images_ = nlohmann::json::array();
  bool has_strength_ = false;
  std::map<String, size_t> known_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_MATERIAL_H_
