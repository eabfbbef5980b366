// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_material.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using nlohmann::json;
using testing::ElementsAre;

std::vector<GltfMaterial> read(const json& document, LeftKinds* left_out) {
  return read_materials(JsonNode(document, "a.gltf"), left_out);
}

const json kScene = json::parse(R"({
  "images": [{"uri": "wood%20grain.png"}, {"bufferView": 0, "name": "glow"}, {"bufferView": 1}],
  "textures": [{"source": 1}, {"source": 0}, {"extensions": {"EXT_texture_webp": {"source": 2}}}],
  "materials": [
    {"name": "wood",
     "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0, 0.75], "roughnessFactor": 0.5,
                              "baseColorTexture": {"index": 1},
                              "metallicRoughnessTexture": {"index": 2}},
     "emissiveFactor": [0, 1, 0], "emissiveTexture": {"index": 0, "texCoord": 1},
     "alphaMode": "MASK", "doubleSided": true,
     "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3},
                    "KHR_materials_clearcoat": {}}},
    {}]})");

TEST(GltfMaterial, HasItsValuesAndTheNamesOfItsImages) {
  LeftKinds left_out;
  const std::vector<GltfMaterial> materials = read(kScene, &left_out);
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials[0].name, "wood");
  const MaterialLook& wood = materials[0].look;
  EXPECT_THAT(wood.base_colour, ElementsAre(0.5F, 0.25F, 0, 0.75F));
  EXPECT_EQ(wood.metallic, 1);
  EXPECT_EQ(wood.roughness, 0.5F);
  EXPECT_THAT(wood.emissive, ElementsAre(0, 3, 0));
  EXPECT_EQ(wood.alpha, AlphaMode::kMask);
  EXPECT_EQ(wood.alpha_cutoff, 0.5F);
  EXPECT_TRUE(wood.double_sided);
  EXPECT_EQ(wood.texture(TextureSlot::kBaseColour), "wood grain.png");
  EXPECT_EQ(wood.texture(TextureSlot::kMetallicRoughness), "#2");
  EXPECT_EQ(wood.texture(TextureSlot::kEmissive), "#glow");
  EXPECT_EQ(materials[1].look.metallic, 1) << "of a material without values";
  EXPECT_EQ(left_out.text(), "that a texture uses other texture coordinates than the first");
}

TEST(GltfMaterial, ComesBack) {
  LeftKinds left_out;
  const std::vector<GltfMaterial> materials = read(kScene, &left_out);
  for (const GltfTextures textures : {GltfTextures::kFiles, GltfTextures::kAll}) {
    const GltfImage glow{"#glow", "image/png", "bytes"};
    size_t added = 0;
    GltfMaterials written(textures, {&glow, 1}, [&](std::string_view bytes) {
      EXPECT_EQ(bytes, "bytes");
      return 7 + added++;
    });
    for (const GltfMaterial& material : materials)
      written.add(material.name, material.look);
    json document;
    written.describe_in(document);
    const std::vector<GltfMaterial> back = read(document, &left_out);
    ASSERT_EQ(back.size(), 2U);
    MaterialLook wood = materials[0].look;
    if (textures == GltfTextures::kFiles) {
      wood.texture(TextureSlot::kMetallicRoughness).clear();
      EXPECT_EQ(added, 1U);
      EXPECT_EQ(document["images"][1]["bufferView"], 7);
    }
    EXPECT_EQ(back[0].look, wood);
    EXPECT_EQ(back[1].look, materials[1].look);
  }
}

TEST(GltfMaterial, OfUnknownLookIsNoMetal) {
  GltfMaterials written(GltfTextures::kFiles);
  written.add("a", {});
  json document;
  written.describe_in(document);
  EXPECT_EQ(document["materials"][0]["pbrMetallicRoughness"]["metallicFactor"], 0);
  EXPECT_FALSE(document.contains("images"));
}

}  // namespace
}  // namespace anicodec::tools
