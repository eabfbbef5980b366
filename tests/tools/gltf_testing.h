// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_TOOLS_GLTF_TESTING_H_
#define ANICODEC_TESTS_TOOLS_GLTF_TESTING_H_

#include "codec/sequence/mesh_sequence.h"
#include "corpus/clips.h"
#include "tools/io/base/byte_order.h"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace anicodec::tools {

/// A small document, put together piece by piece, with a binary chunk.
struct GltfScene {
  nlohmann::json document;
  std::string binary;

  template <typename Number>
  size_t view(const std::vector<Number>& values) {
    binary.resize((binary.size() + 3) / 4 * 4);
    document["bufferViews"].push_back({{"buffer", 0},
                                       {"byteOffset", binary.size()},
                                       {"byteLength", values.size() * sizeof(Number)}});
    for (Number x : values)
      append(x, std::endian::little, binary);
    document["buffers"] = nlohmann::json::array({{{"byteLength", binary.size()}}});
    return document["bufferViews"].size() - 1;
  }

  template <typename Number>
  size_t accessor(const std::vector<Number>& values, const std::string& type, int component,
                  size_t components) {
    document["accessors"].push_back({{"bufferView", view(values)},
                                     {"componentType", component},
                                     {"count", values.size() / components},
                                     {"type", type}});
    return document["accessors"].size() - 1;
  }

  size_t scalars(const std::vector<float>& values) { return accessor(values, "SCALAR", 5126, 1); }

  size_t vectors(const std::vector<float>& values) { return accessor(values, "VEC3", 5126, 3); }

  size_t quads(const std::vector<float>& values) { return accessor(values, "VEC4", 5126, 4); }

  size_t matrices(const std::vector<float>& values) { return accessor(values, "MAT4", 5126, 16); }

  size_t joints(const std::vector<uint16_t>& v) { return accessor(v, "VEC4", 5123, 4); }

  size_t indices(const std::vector<uint16_t>& v) { return accessor(v, "SCALAR", 5123, 1); }

  nlohmann::json& primitive(size_t mesh = 0, size_t index = 0) {
    return document["meshes"][mesh]["primitives"][index];
  }

  /// Adds an animation of one channel.
  void animate(size_t node, const std::string& path, const std::vector<float>& times, size_t output,
               const std::string& interpolation = "LINEAR", const std::string& name = "") {
    nlohmann::json animation{
        {"samplers",
         {{{"input", scalars(times)}, {"output", output}, {"interpolation", interpolation}}}},
        {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}};
    if (!name.empty())
      animation["name"] = name;
    document["animations"].push_back(animation);
  }

  std::string glb() const {
    std::string json = document.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string chunk = binary;
    chunk.resize((chunk.size() + 3) / 4 * 4);
    std::string out = "glTF";
    auto add = [&out](size_t x) { append(static_cast<uint32_t>(x), std::endian::little, out); };
    add(2);
    add(28 + json.size() + chunk.size());
    add(json.size());
    out += "JSON" + json;
    add(chunk.size());
    out += std::string("BIN\0", 4) + chunk;
    return out;
  }
};

/// A triangle (0 0 0, 1 0 0, 0 1 0) shown by node 0.
inline GltfScene triangle_scene() {
  GltfScene scene;
  scene.document = {{"asset", {{"version", "2.0"}}},
                    {"scene", 0},
                    {"scenes", {{{"nodes", {0}}}}},
                    {"nodes", {{{"mesh", 0}, {"name", "object"}}}}};
  const size_t positions = scene.vectors({0, 0, 0, 1, 0, 0, 0, 1, 0});
  scene.document["meshes"] = nlohmann::json::array(
      {{{"name", "triangle"},
        {"primitives", nlohmann::json::array({{{"attributes", {{"POSITION", positions}}}}})}}});
  return scene;
}

/// The limb of the corpus, in the axes of glTF.
inline MeshSequence gltf_limb() {
  MeshSequence clip = corpus::make_clip("limb");
  clip.up = UpAxis::kY;
  clip.metres_per_unit = 1;
  return clip;
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_TOOLS_GLTF_TESTING_H_
