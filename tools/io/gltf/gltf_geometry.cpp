// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_geometry.h"

#include "tools/io/gltf/gltf_accessor.h"
#include "tools/io/gltf/gltf_compression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace anicodec::tools {
namespace {

constexpr uint32_t kTriangleList = 4, kFan = 6;  // 5: strip

/// Reads the attributes of one primitive, from accessors or from a Draco bitstream.
class AttributeReader {
 public:
  AttributeReader(const GltfDocument& document, uint32_t mesh, size_t primitive,
                  const GltfOptions& options)
      : document_(document),
        primitive_(document.meshes[mesh].primitives[primitive]),
        path_(primitive_path(mesh, primitive)) {
    if (!primitive_.draco)
      return;
    if (primitive_.indices == kGltfNone)
      fail_gltf(document, path_, "a Draco bitstream without an accessor of indices");
    const uint32_t position = primitive_.attributes.at("POSITION");
    const DracoSource source{document.views[primitive_.draco->view].bytes,
                             primitive_.draco->attributes, document.accessors[position].count,
                             document.accessors[primitive_.indices].count};
    draco_ = options.isolate
                 ? decode_draco_guarded(source, document.name + ": " + path_, options.memory_limit)
                 : decode_draco(source);
    if (!draco_)
      fail_gltf(document, path_ + "/extensions/KHR_draco_mesh_compression",
                "the Draco bitstream is damaged, or is not what the accessors say");
  }

  const std::string& path() const { return path_; }

  const DracoPrimitive* draco() const { return draco_ ? &*draco_ : nullptr; }

  bool has(const std::string& name) const { return primitive_.attributes.contains(name); }

  /// Values of an attribute; throws unless it has as many components.
  std::vector<float> floats(const std::string& name, uint32_t components) const {
    const uint32_t index = primitive_.attributes.at(name);
    const std::string path = path_ + "/attributes/" + name;
    check_components(index, components, path);
    const DracoPrimitive::Values* coded = coded_values(name, components, path);
    if (!coded)
      return read_floats(document_, index, path);
    std::vector<float> out = coded->values;
    if (document_.accessors[index].normalized) {
      for (float& x : out)
        x *= coded->normalizing_scale;
    }
    if (!std::all_of(out.begin(), out.end(), [](float x) { return std::isfinite(x); }))
      fail_gltf(document_, path, "an element is not finite");
    return out;
  }

  std::vector<uint32_t> integers(const std::string& name, uint32_t components) const {
    const uint32_t index = primitive_.attributes.at(name);
    const std::string path = path_ + "/attributes/" + name;
    check_components(index, components, path);
    const DracoPrimitive::Values* coded = coded_values(name, components, path);
    if (!coded)
      return read_unsigned(document_, index, path);
    std::vector<uint32_t> out;
    for (float x : coded->values) {
      if (!(x >= 0 && x < 65536))
        fail_gltf(document_, path, "an element is not an index");
      out.push_back(static_cast<uint32_t>(x));
    }
    return out;
  }

  /// The differences that the targets add to an attribute; empty for a target that does not change it.
  std::vector<float> added(size_t target, const std::string& name, uint32_t components = 3) const {
    const auto& attributes = primitive_.targets[target];
    auto found = attributes.find(name);
    if (found == attributes.end())
      return {};
    const std::string path = path_ + "/targets/" + std::to_string(target) + "/" + name;
    check_components(found->second, components, path);
    return read_floats(document_, found->second, path);
  }

  uint32_t components(const std::string& name) const {
    return document_.accessors[primitive_.attributes.at(name)].components;
  }

 private:
  void check_components(uint32_t accessor, uint32_t components, const std::string& path) const {
    if (document_.accessors[accessor].components != components)
      fail_gltf(document_, path,
                "/accessors/" + std::to_string(accessor) + " has " +
                    std::to_string(document_.accessors[accessor].components) + " components; " +
                    std::to_string(components) + " are expected");
  }

  const DracoPrimitive::Values* coded_values(const std::string& name, uint32_t components,
                                             const std::string& path) const {
    if (!draco_ || !draco_->attributes.contains(name))
      return nullptr;
    const DracoPrimitive::Values& values = draco_->attributes.at(name);
    if (values.components != components)
      fail_gltf(document_, path,
                "the Draco bitstream has " + std::to_string(values.components) + " components; " +
                    std::to_string(components) + " are expected");
    return &values;
  }

  const GltfDocument& document_;
  const GltfPrimitive& primitive_;
  std::string path_;
  std::optional<DracoPrimitive> draco_;
};

/// Weights that do not sum to one are scaled; a vertex without any follows its first joint.
void normalize_weights(uint32_t influences, std::vector<float>& weights) {
  for (size_t v = 0; v < weights.size(); v += influences) {
    float sum =
        std::accumulate(weights.begin() + static_cast<std::ptrdiff_t>(v),
                        weights.begin() + static_cast<std::ptrdiff_t>(v + influences), 0.0F);
    if (!(sum > 0)) {
      weights[v] = 1;
      sum = 1;
    }
    for (size_t i = 0; i < influences; ++i)
      weights[v + i] /= sum;
  }
}

void read_joints(const GltfDocument& document, const AttributeReader& in, GltfVertices& out) {
  std::vector<std::vector<uint32_t>> joints;
  std::vector<std::vector<float>> weights;
  for (size_t set = 0;; ++set) {
    const std::string number = std::to_string(set);
    if (!in.has("JOINTS_" + number))
      break;
    if (!in.has("WEIGHTS_" + number))
      fail_gltf(document, in.path() + "/attributes",
                "JOINTS_" + number + " without WEIGHTS_" + number);
    joints.push_back(in.integers("JOINTS_" + number, 4));
    weights.push_back(in.floats("WEIGHTS_" + number, 4));
    for (size_t i = 0; i < weights.back().size(); ++i) {
      if (weights.back()[i] < 0)
        fail_gltf(document, in.path() + "/attributes/WEIGHTS_" + number,
                  "element " + std::to_string(i / 4) + " is negative");
    }
  }
  out.influences = static_cast<uint32_t>(4 * joints.size());
  for (size_t v = 0; v < out.count && out.influences > 0; ++v) {
    for (size_t set = 0; set < joints.size(); ++set) {
      for (size_t i = 4 * v; i < 4 * v + 4; ++i) {
        out.joints.push_back(joints[set][i]);
        out.weights.push_back(weights[set][i]);
      }
    }
  }
  if (out.influences > 0)
    normalize_weights(out.influences, out.weights);
}

std::vector<float> with_alpha(std::vector<float> colours, uint32_t components, float alpha) {
  if (components == 4)
    return colours;
  std::vector<float> out;
  for (size_t i = 0; i + 2 < colours.size(); i += 3)
    out.insert(out.end(), {colours[i], colours[i + 1], colours[i + 2], alpha});
  return out;
}

/// Moves texture coordinates, or with `offset` 0 differences of them. False: some are not finite then.
bool move_coordinates(const TextureTransform& transform, double offset, std::vector<float>& uvs) {
  const std::array<double, 6>& m = transform.matrix;
  for (size_t i = 0; i + 1 < uvs.size(); i += 2) {
    const auto u = static_cast<double>(uvs[i]), v = static_cast<double>(uvs[i + 1]);
    uvs[i] = static_cast<float>(m[0] * u + m[1] * v + m[2] * offset);
    uvs[i + 1] = static_cast<float>(m[3] * u + m[4] * v + m[5] * offset);
  }
  return std::ranges::all_of(uvs, [](float x) { return std::isfinite(x); });
}

/// Texture coordinates as the material moves them.
void apply_transforms(const GltfDocument& document, uint32_t material, GltfVertices& vertices) {
  for (const auto& [set, transform] : document.materials[material].transforms) {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    bool finite = true;
    if (const auto found = vertices.uvs.find(name); found != vertices.uvs.end())
      finite &= move_coordinates(transform, 1, found->second);
    for (GltfVectors& target : vertices.targets) {
      if (const auto found = target.sets.find(name); found != target.sets.end())
        finite &= move_coordinates(transform, 0, found->second);
    }
    if (!finite)
      fail_gltf(document, "/materials/" + std::to_string(material),
                "KHR_texture_transform moves " + name + " beyond 32-bit floats");
  }
}

GltfVertices read_vertices(const GltfDocument& document, const AttributeReader& in,
                           const GltfPrimitive& primitive) {
  GltfVertices out;
  out.base.positions = in.floats("POSITION", 3);
  out.count = static_cast<uint32_t>(out.base.positions.size() / 3);
  if (in.has("NORMAL"))
    out.base.normals = in.floats("NORMAL", 3);
  if (in.has("TANGENT"))
    out.tangents = in.floats("TANGENT", 4);
  for (const auto& [name, accessor] : primitive.attributes) {
    if (name.starts_with("TEXCOORD_"))
      out.uvs[name] = in.floats(name, 2);
    else if (name.starts_with("COLOR_"))
      out.colours[name] =
          with_alpha(in.floats(name, in.components(name) == 3 ? 3 : 4), in.components(name), 1);
  }
  for (size_t t = 0; t < primitive.targets.size(); ++t) {
    GltfVectors& target = out.targets.emplace_back();
    target.positions = in.added(t, "POSITION");
    target.normals = in.added(t, "NORMAL");
    for (const auto& [name, accessor] : primitive.targets[t]) {
      if (out.uvs.contains(name))
        target.sets[name] = in.added(t, name, 2);
      else if (out.colours.contains(name))
        target.sets[name] =
            with_alpha(in.added(t, name, in.components(name)), in.components(name), 0);
    }
  }
  read_joints(document, in, out);
  return out;
}

std::vector<uint32_t> triangle_list(const std::vector<uint32_t>& corners, uint32_t mode) {
  if (mode == kTriangleList)
    return corners;
  std::vector<uint32_t> out;
  for (size_t i = 2; i < corners.size(); ++i) {
    if (mode == kFan)
      out.insert(out.end(), {corners[0], corners[i - 1], corners[i]});
    else if (i % 2 == 0)
      out.insert(out.end(), {corners[i - 2], corners[i - 1], corners[i]});
    else
      out.insert(out.end(), {corners[i - 1], corners[i - 2], corners[i]});
  }
  return out;
}

}  // namespace

std::string primitive_path(uint32_t mesh, size_t primitive) {
  return "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(primitive);
}

GltfGeometry read_geometry(const GltfDocument& document, uint32_t mesh, size_t index,
                           const GltfOptions& options) {
  const GltfPrimitive& primitive = document.meshes[mesh].primitives[index];
  const AttributeReader in(document, mesh, index, options);
  GltfGeometry out;
  out.vertices = read_vertices(document, in, primitive);
  if (primitive.material != kGltfNone && !options.scene_stays)
    apply_transforms(document, primitive.material, out.vertices);

  const std::string path = in.path() + "/indices";
  std::vector<uint32_t> corners;
  if (in.draco()) {
    corners = in.draco()->indices;
  } else if (primitive.indices != kGltfNone) {
    if (document.accessors[primitive.indices].components != 1)
      fail_gltf(document, path, "the indices are not scalars");
    corners = read_unsigned(document, primitive.indices, path);
  } else {
    corners.resize(out.vertices.count);
    std::iota(corners.begin(), corners.end(), 0U);
  }
  for (size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] >= out.vertices.count)
      fail_gltf(document, path,
                "index " + std::to_string(i) + " is " + std::to_string(corners[i]) +
                    ", out of bounds; there are " + std::to_string(out.vertices.count) +
                    " vertices");
  }
  if (primitive.mode == kTriangleList && corners.size() % 3 != 0)
    fail_gltf(document, in.path(),
              std::to_string(corners.size()) + " corners do not make triangles");
  out.triangles = triangle_list(corners, primitive.mode);
  return out;
}

}  // namespace anicodec::tools
