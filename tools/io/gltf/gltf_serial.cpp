// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_serial.h"

#include "tools/io/base/byte_order.h"
#include "tools/io/base/mesh.h"
#include "tools/io/gltf/gltf_material.h"

#include <array>
#include <bit>
#include <string_view>

#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

using Json = nlohmann::json;

constexpr size_t kAlignment = 8;  // of views; every component's size divides it

const char* type_name(const GltfAccessor& accessor) {
  constexpr std::array<const char*, 5> kVectors = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  return accessor.components == 16 ? "MAT4" : kVectors.at(accessor.components);
}

const char* path_name(GltfPath path) {
  constexpr std::array<const char*, 4> kNames = {"translation", "rotation", "scale", "weights"};
  return kNames.at(static_cast<size_t>(path));
}

const char* interpolation_name(GltfInterpolation interpolation) {
  constexpr std::array<const char*, 3> kNames = {"STEP", "LINEAR", "CUBICSPLINE"};
  return kNames.at(static_cast<size_t>(interpolation));
}

void set_index(Json& json, const char* key, uint32_t index) {
  if (index != kGltfNone)
    json[key] = index;
}

Json views(const GltfDocument& document, std::string& binary) {
  Json out = Json::array();
  for (const GltfView& view : document.views) {
    Json& json = out.emplace_back();
    json = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", view.bytes.size()}};
    if (view.stride > 0)
      json["byteStride"] = view.stride;
    binary += view.bytes;
    binary.resize((binary.size() + kAlignment - 1) / kAlignment * kAlignment);
  }
  return out;
}

Json accessors(const GltfDocument& document) {
  Json out = Json::array();
  for (const GltfAccessor& accessor : document.accessors) {
    // A matrix is 16 numbers here as there: what has the components of one is one.
    Json& json = out.emplace_back();
    json = {{"byteOffset", accessor.offset},
            {"count", accessor.count},
            {"type", type_name(accessor)},
            {"componentType", static_cast<uint32_t>(accessor.type)},
            {"normalized", accessor.normalized}};
    set_index(json, "bufferView", accessor.view);
  }
  return out;
}

Json meshes(const GltfDocument& document) {
  Json out = Json::array();
  for (const GltfMesh& mesh : document.meshes) {
    Json& json = out.emplace_back();
    json = {{"name", mesh.name}, {"primitives", Json::array()}};
    if (!mesh.weights.empty())
      json["weights"] = mesh.weights;
    for (const GltfPrimitive& primitive : mesh.primitives) {
      Json& part = json["primitives"].emplace_back();
      part = {{"attributes", primitive.attributes}, {"mode", primitive.mode}};
      set_index(part, "indices", primitive.indices);
      set_index(part, "material", primitive.material);
      if (!primitive.targets.empty())
        part["targets"] = primitive.targets;
    }
  }
  return out;
}

Json nodes(const GltfDocument& document) {
  Json out = Json::array();
  for (const GltfNode& node : document.nodes) {
    Json& json = out.emplace_back();
    json = {{"name", node.name}, {"children", node.children}};
    set_index(json, "mesh", node.mesh);
    set_index(json, "skin", node.skin);
    if (node.matrix) {
      json["matrix"] = *node.matrix;
    } else {
      json["translation"] = node.translation;
      json["rotation"] = node.rotation;
      json["scale"] = node.scale;
    }
    if (!node.weights.empty())
      json["weights"] = node.weights;
  }
  return out;
}

Json skins(const GltfDocument& document) {
  Json out = Json::array();
  for (const GltfSkin& skin : document.skins) {
    Json& json = out.emplace_back();
    json = {{"joints", skin.joints}};
    set_index(json, "inverseBindMatrices", skin.inverse_binds);
  }
  return out;
}

Json animations(const GltfDocument& document) {
  Json out = Json::array();
  for (const GltfAnimation& animation : document.animations) {
    Json& json = out.emplace_back();
    json = {{"name", animation.name}, {"samplers", Json::array()}, {"channels", Json::array()}};
    for (const GltfSampler& sampler : animation.samplers)
      json["samplers"].push_back({{"input", sampler.input},
                                  {"output", sampler.output},
                                  {"interpolation", interpolation_name(sampler.interpolation)}});
    for (const GltfChannel& channel : animation.channels)
      json["channels"].push_back(
          {{"sampler", channel.sampler},
           {"target", {{"node", channel.node}, {"path", path_name(channel.path)}}}});
  }
  return out;
}

void append_chunk(std::string_view type, std::string_view bytes, char filling, std::string& out) {
  const size_t padding = (4 - bytes.size() % 4) % 4;
  append(static_cast<uint32_t>(bytes.size() + padding), std::endian::little, out);
  out += type;
  out += bytes;
  out.append(padding, filling);
}

}  // namespace

std::string glb_of(const GltfDocument& document) {
  std::string binary;
  Json json = {{"asset", {{"version", "2.0"}}},      {"bufferViews", views(document, binary)},
               {"accessors", accessors(document)},   {"meshes", meshes(document)},
               {"nodes", nodes(document)},           {"skins", skins(document)},
               {"animations", animations(document)}, {"scenes", {{{"nodes", document.roots}}}}};
  GltfMaterials materials(GltfTextures::kAll);
  for (const GltfMaterial& material : document.materials)
    materials.add(material.name, material.look);
  materials.describe_in(json);
  json["buffers"] = {{{"byteLength", binary.size()}}};
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr size_t kHeads = 12 + 8 + 8 + 8;  // with the padding of both chunks
  if (text.size() + binary.size() + kHeads > UINT32_MAX)
    fail_input(document.name, "the scene has more than 4 GB");
  std::string chunks;
  append_chunk("JSON", text, ' ', chunks);
  append_chunk(std::string_view("BIN\0", 4), binary, '\0', chunks);
  std::string out = "glTF";
  append(uint32_t{2}, std::endian::little, out);
  append(static_cast<uint32_t>(chunks.size() + 12), std::endian::little, out);
  return out + chunks;
}

}  // namespace anicodec::tools
