// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_document.h"

#include "codec/sequence/error.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/gltf/gltf_compression.h"
#include "tools/io/gltf/gltf_container.h"
#include "tools/io/gltf/gltf_facing.h"
#include "tools/io/gltf/json_node.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr const char* kVisibility = "KHR_node_visibility";
constexpr const char* kPointer = "KHR_animation_pointer";
constexpr const char* kHalfFloats = "KHR_accessor_float16";
constexpr uint64_t kMaxBytes = uint64_t{1} << 40;
constexpr uint64_t kMaxElements = kMaxVertices;

std::optional<JsonNode> extension(const JsonNode& node, const char* name) {
  std::optional<JsonNode> extensions = node.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

/// The extension by which a buffer or a view names its compression by meshoptimizer.
std::optional<JsonNode> meshopt_extension(const JsonNode& node) {
  for (const char* name : kMeshoptExtensions) {
    if (std::optional<JsonNode> found = extension(node, name))
      return found;
  }
  return std::nullopt;
}

uint64_t whole_or(const JsonNode& node, const char* key, uint64_t otherwise, uint64_t limit) {
  std::optional<JsonNode> found = node.find(key);
  return found ? found->whole(limit) : otherwise;
}

uint32_t index_or_none(const JsonNode& node, const char* key, size_t count, const char* what) {
  std::optional<JsonNode> found = node.find(key);
  return found ? found->index(count, what) : kGltfNone;
}

/// Reads the parts of a document in an order in which all that one refers to has been counted.
class Reader {
 public:
  Reader(const GltfContainer& container, std::string_view name, const GltfResolver& resolve,
         uint64_t memory_limit, bool allow_outside)
      : container_(container),
        root_(container.document, name, &readings_),
        resolve_(resolve),
        memory_limit_(memory_limit),
        memory_left_(memory_limit),
        allow_outside_(allow_outside) {
    out_.name = name;
  }

  GltfDocument read() {
    check_version();
    for (const JsonNode& node : root_.elements("buffers"))
      read_buffer(node);
    for (const JsonNode& node : root_.elements("bufferViews"))
      read_view(node);
    for (const JsonNode& node : root_.elements("accessors"))
      out_.accessors.push_back(read_accessor(node));
    out_.materials = read_materials(root_, &out_.left_out);
    for (const JsonNode& node : root_.elements("images"))
      read_image(node);
    for (const JsonNode& node : root_.elements("meshes"))
      out_.meshes.push_back(read_mesh(node));
    const std::vector<JsonNode> nodes = root_.elements("nodes");
    const std::vector<JsonNode> skins = root_.elements("skins");
    for (const JsonNode& node : nodes)
      out_.nodes.push_back(read_node(node, nodes.size(), skins.size()));
    check_hierarchy(nodes);
    for (const JsonNode& node : skins)
      out_.skins.push_back(read_skin(node));
    read_scene();
    for (const JsonNode& node : root_.elements("animations"))
      out_.animations.push_back(read_animation(node));
    find_facings(&out_);
    list_left_out();
    return std::move(out_);
  }

 private:
  /// Names what the document has and no one asked for.
  void list_left_out() {
    for (const std::string& kind : readings_.missing(container_.document)) {
      if (const std::string text = text_of_missing(kind); !text.empty())
        out_.left_out.add(text);
    }
    const size_t images = static_cast<size_t>(std::ranges::count_if(
        root_.elements("images"), [](const JsonNode& node) { return is_inside(node); }));
    if (images > 0)
      out_.left_out.add(counted_kind(images, "image") + " inside the scene");
  }

  /// Empty for what says nothing about the scene: names of accessors, for instance.
  std::string text_of_missing(const std::string& kind) const {
    constexpr std::string_view kExtensions = "/extensions/";
    if (const size_t at = kind.find(kExtensions); at != std::string::npos) {
      const std::string name = kind.substr(at + kExtensions.size());
      const size_t slash = name.find('/');
      if (name == "KHR_lights_punctual")
        return "lights";
      if (slash == std::string::npos)
        return name;
      const std::string owner = name.substr(0, slash);
      const bool is_compression = owner == kMeshoptExtensions[0] || owner == kMeshoptExtensions[1];
      return is_compression ? "" : "'" + name.substr(slash + 1) + "' of " + owner;
    }
    const std::string key = kind.substr(kind.rfind('/') + 1);
    const std::string owner = kind.substr(1, kind.find('/', 1) - 1);
    if (key == "extras")
      return "custom properties";
    if (kind == "/cameras")
      return counted_kind(root_.elements("cameras").size(), "camera");
    if (kind == "/samplers")
      return textures_repeat() ? "" : "how textures repeat";
    if (kind == "/scenes/nodes")
      return "other scenes";
    constexpr std::string_view kNothing[] = {"accessors", "asset",          "bufferViews",
                                             "buffers",   "extensionsUsed", "images"};
    constexpr std::string_view kNoKeys[] = {"camera", "name", "sampler", "skeleton"};
    if (std::ranges::find(kNothing, owner) != std::end(kNothing) ||
        std::ranges::find(kNoKeys, key) != std::end(kNoKeys))
      return "";
    return kind == "/" + key ? "'" + key + "'" : "'" + key + "' of " + owner;
  }

  /// Whether all textures go on beyond their borders, as those without a sampler do.
  bool textures_repeat() const {
    constexpr uint64_t kRepeat = 10497;
    return std::ranges::all_of(root_.elements("samplers"), [&](const JsonNode& node) {
      return whole_or(node, "wrapS", kRepeat, UINT32_MAX) == kRepeat &&
             whole_or(node, "wrapT", kRepeat, UINT32_MAX) == kRepeat;
    });
  }

  void check_version() {
    const JsonNode version = root_.member("asset").member("version");
    if (!version.text().starts_with("2."))
      version.fail("version '" + shown(version.text()) + "'; 2.0 is read");
    // These add nothing to a document that changes the places of vertices.
    constexpr std::string_view kHarmless[] = {
        "KHR_materials_", "KHR_texture_", "EXT_texture_",         "KHR_lights_",
        "KHR_xmp",        "EXT_lights_",  "KHR_mesh_quantization"};
    for (const JsonNode& node : root_.elements("extensionsRequired")) {
      const std::string name = node.text();
      bool known = name == kMeshoptExtensions[0] || name == kMeshoptExtensions[1] ||
                   name == kHalfFloats || name == kDracoExtension || name == kVisibility ||
                   name == kPointer || name == kInstancingExtension;
      for (std::string_view prefix : kHarmless)
        known |= name.starts_with(prefix);
      if (!known)
        throw Error(ErrorKind::kUnsupported, out_.name + ": " + node.path() + ": extension '" +
                                                 shown(name) + "' is required, but not known");
    }
  }

  void read_buffer(const JsonNode& node) {
    const uint64_t length = node.member("byteLength").whole(kMaxBytes);
    std::vector<char>& bytes = out_.buffers.emplace_back();
    // Takes the place of compressed views in readers that do not know them.
    if (meshopt_extension(node))
      return;
    std::optional<JsonNode> uri = node.find("uri");
    if (!uri) {
      if (out_.buffers.size() > 1 || !container_.binary)
        node.fail("the buffer is missing: it has no 'uri', and is not the binary chunk of a GLB");
      bytes.assign(container_.binary->begin(), container_.binary->end());
    } else if (std::string text = uri->text(); is_data_uri(text)) {
      bytes = decode_data_uri(text, *uri);
    } else {
      const std::string path = path_of_uri(text, *uri, allow_outside_);
      try {
        const std::string file = resolve_(path);
        bytes.assign(file.begin(), file.end());
      } catch (const Error& e) {
        uri->fail("the buffer is missing: " + std::string(e.what()));
      }
    }
    if (bytes.size() < length)
      node.fail("the buffer has " + std::to_string(bytes.size()) + " bytes of the " +
                std::to_string(length) + " of its byteLength");
    bytes.resize(length);
    out_.bytes += length;
  }

  /// Images inside the document alone.
  void read_image(const JsonNode& node) {
    GltfImage& image = out_.images.emplace_back();
    if (!is_inside(node))
      return;
    image.name = name_inside(node, out_.images.size() - 1);
    image.type = text_or_empty(node, "mimeType");
    if (const std::optional<JsonNode> uri = node.find("uri")) {
      const std::string text = uri->text();
      const std::vector<char> bytes = decode_data_uri(text, *uri);
      image.bytes.assign(bytes.begin(), bytes.end());
      image.type = text.substr(5, text.find(';') - 5);
    } else if (const std::optional<JsonNode> view = node.find("bufferView")) {
      image.bytes = out_.views[view->index(out_.views.size(), "bufferViews")].bytes;
    }
  }

  std::string_view range_of_buffer(const JsonNode& node) {
    const uint32_t buffer = node.member("buffer").index(out_.buffers.size(), "buffers");
    const uint64_t offset = whole_or(node, "byteOffset", 0, kMaxBytes);
    const uint64_t length = node.member("byteLength").whole(kMaxBytes);
    const std::vector<char>& bytes = out_.buffers[buffer];
    if (offset + length > bytes.size())
      node.fail("bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                " are out of bounds; /buffers/" + std::to_string(buffer) + " has " +
                std::to_string(bytes.size()));
    return {bytes.data() + offset, length};
  }

  void read_view(const JsonNode& node) {
    GltfView view;
    view.stride = static_cast<uint32_t>(whole_or(node, "byteStride", 0, 252));
    if (std::optional<JsonNode> packed = meshopt_extension(node)) {
      MeshoptView source;
      source.bytes = range_of_buffer(*packed);
      source.count = static_cast<uint32_t>(packed->member("count").whole(kMaxElements));
      source.stride = static_cast<uint32_t>(packed->member("byteStride").whole(256));
      source.mode = packed->member("mode").text();
      source.filter = text_or_empty(*packed, "filter");
      take_memory(uint64_t{source.count} * source.stride, *packed);
      view.decompressed = decode_meshopt(source, *packed);
      out_.bytes += view.decompressed.size();
      view.bytes = {view.decompressed.data(), view.decompressed.size()};
    } else {
      view.bytes = range_of_buffer(node);
    }
    out_.views.push_back(std::move(view));
  }

  void take_memory(uint64_t bytes, const JsonNode& node) {
    if (bytes > memory_left_)
      node.fail("needs " + std::to_string(bytes) + " bytes of memory; " +
                std::to_string(memory_left_) + " are left of the " + std::to_string(memory_limit_) +
                " that are allowed");
    memory_left_ -= bytes;
  }

  GltfComponent read_component(const JsonNode& node) {
    const JsonNode type = node.member("componentType");
    const auto component = static_cast<GltfComponent>(type.whole(UINT32_MAX));
    if (size_of(component) == 0)
      type.fail("is not the number of a type of component");
    return component;
  }

  /// Checks that elements lie within a view.
  void check_range(const JsonNode& node, uint32_t view, uint64_t offset, uint64_t count,
                   uint64_t element, uint64_t component) {
    const GltfView& v = out_.views[view];
    const uint64_t stride = v.stride > 0 ? v.stride : element;
    if (stride < element)
      node.fail("elements of " + std::to_string(element) + " bytes, but /bufferViews/" +
                std::to_string(view) + " has a stride of " + std::to_string(stride));
    if (offset % component != 0 || stride % component != 0)
      node.fail("the elements are not aligned to their components of " + std::to_string(component) +
                " bytes");
    const uint64_t end = count == 0 ? offset : offset + (count - 1) * stride + element;
    if (end > v.bytes.size())
      node.fail(std::to_string(count) + " elements end at byte " + std::to_string(end) +
                ", out of bounds: /bufferViews/" + std::to_string(view) + " has " +
                std::to_string(v.bytes.size()) + " bytes");
  }

  GltfAccessor read_accessor(const JsonNode& node) {
    constexpr std::pair<std::string_view, uint32_t> kTypes[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
        {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    GltfAccessor accessor;
    const JsonNode type = node.member("type");
    const std::string type_name = type.text();
    const auto* found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                     [&](const auto& t) { return t.first == type_name; });
    if (found == std::end(kTypes))
      type.fail("'" + shown(type_name) + "' is not a type of accessor");
    accessor.components = found->second;
    accessor.matrix = type_name.starts_with("MAT");
    accessor.type = read_component(node);
    accessor.count = static_cast<uint32_t>(node.member("count").whole(kMaxElements));
    if (std::optional<JsonNode> normalized = node.find("normalized"))
      accessor.normalized = normalized->boolean();
    accessor.view = index_or_none(node, "bufferView", out_.views.size(), "buffer views");
    accessor.offset = whole_or(node, "byteOffset", 0, kMaxBytes);
    const uint64_t component = size_of(accessor.type);
    // Columns of matrices of small components are padded; no matrix of glTF has any.
    if (accessor.matrix && accessor.type != GltfComponent::kFloat &&
        !(accessor.type == GltfComponent::kHalf && accessor.components == 16))
      node.fail("matrices of other than floats are not read");
    if (accessor.view != kGltfNone)
      check_range(node, accessor.view, accessor.offset, accessor.count,
                  accessor.components * component, component);
    else
      take_memory(uint64_t{accessor.count} * accessor.components * sizeof(float), node);
    if (std::optional<JsonNode> sparse = node.find("sparse"))
      accessor.sparse = read_sparse(*sparse, accessor);
    return accessor;
  }

  GltfSparse read_sparse(const JsonNode& node, const GltfAccessor& accessor) {
    GltfSparse sparse;
    sparse.count = static_cast<uint32_t>(node.member("count").whole(accessor.count));
    const JsonNode indices = node.member("indices"), values = node.member("values");
    sparse.index_view = indices.member("bufferView").index(out_.views.size(), "buffer views");
    sparse.index_offset = whole_or(indices, "byteOffset", 0, kMaxBytes);
    sparse.index_type = read_component(indices);
    if (sparse.index_type != GltfComponent::kUint8 && sparse.index_type != GltfComponent::kUint16 &&
        sparse.index_type != GltfComponent::kUint32)
      indices.fail("the indices are not unsigned integers");
    sparse.value_view = values.member("bufferView").index(out_.views.size(), "buffer views");
    sparse.value_offset = whole_or(values, "byteOffset", 0, kMaxBytes);
    const uint64_t component = size_of(accessor.type);
    check_range(indices, sparse.index_view, sparse.index_offset, sparse.count,
                size_of(sparse.index_type), size_of(sparse.index_type));
    check_range(values, sparse.value_view, sparse.value_offset, sparse.count,
                accessor.components * component, component);
    return sparse;
  }

  std::map<std::string, uint32_t> read_attributes(const JsonNode& node) {
    std::map<std::string, uint32_t> attributes;
    for (const auto& [name, value] : node.members())
      attributes[name] = value.index(out_.accessors.size(), "accessors");
    return attributes;
  }

  /// Whether an attribute becomes positions or an attribute of the clip.
  static bool is_kept(std::string_view attribute) {
    constexpr std::string_view kKept[] = {"POSITION", "NORMAL",  "TANGENT", "TEXCOORD_",
                                          "COLOR_",   "JOINTS_", "WEIGHTS_"};
    return std::ranges::any_of(
        kKept, [&](std::string_view beginning) { return attribute.starts_with(beginning); });
  }

  GltfPrimitive read_primitive(const JsonNode& node) {
    GltfPrimitive primitive;
    primitive.attributes = read_attributes(node.member("attributes"));
    primitive.indices = index_or_none(node, "indices", out_.accessors.size(), "accessors");
    primitive.material = index_or_none(node, "material", out_.materials.size(), "materials");
    primitive.mode = static_cast<uint32_t>(whole_or(node, "mode", 4, 6));
    if (primitive.mode < 4)
      out_.left_out.add(primitive.mode == 0 ? "points" : "lines");
    for (const auto& [name, accessor] : primitive.attributes) {
      if (!is_kept(name))
        out_.left_out.add("attribute " + shown(name));
    }
    for (const JsonNode& target : node.elements("targets"))
      primitive.targets.push_back(read_attributes(target));
    if (std::optional<JsonNode> packed = extension(node, kDracoExtension)) {
      GltfDraco draco;
      draco.view = packed->member("bufferView").index(out_.views.size(), "buffer views");
      for (const auto& [name, value] : packed->member("attributes").members())
        draco.attributes[name] = static_cast<uint32_t>(value.whole(UINT32_MAX));
      primitive.draco = std::move(draco);
    }
    check_counts(node, primitive);
    return primitive;
  }

  void check_counts(const JsonNode& node, const GltfPrimitive& primitive) {
    auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end())
      return;
    const uint32_t count = out_.accessors[position->second].count;
    auto check = [&](const std::map<std::string, uint32_t>& attributes, const std::string& place) {
      for (const auto& [name, accessor] : attributes) {
        if (out_.accessors[accessor].count != count)
          node.fail(place + shown(name) + " has " + std::to_string(out_.accessors[accessor].count) +
                    " elements, but POSITION " + std::to_string(count));
      }
    };
    check(primitive.attributes, "");
    for (size_t t = 0; t < primitive.targets.size(); ++t)
      check(primitive.targets[t], "target " + std::to_string(t) + ": ");
  }

  GltfMesh read_mesh(const JsonNode& node) {
    GltfMesh mesh;
    mesh.name = text_or_empty(node, "name");
    node.member("primitives");
    for (const JsonNode& primitive : node.elements("primitives")) {
      mesh.primitives.push_back(read_primitive(primitive));
      if (mesh.primitives.back().targets.size() != mesh.primitives[0].targets.size())
        primitive.fail("has " + std::to_string(mesh.primitives.back().targets.size()) +
                       " morph targets, but the first primitive " +
                       std::to_string(mesh.primitives[0].targets.size()));
    }
    if (mesh.primitives.empty())
      node.fail("the mesh has no primitive");
    if (std::optional<JsonNode> weights = node.find("weights"))
      mesh.weights = weights->numbers(mesh.primitives[0].targets.size());
    return mesh;
  }

  GltfNode read_node(const JsonNode& node, size_t nodes, size_t skins) {
    GltfNode out;
    out.name = text_or_empty(node, "name");
    for (const JsonNode& child : node.elements("children"))
      out.children.push_back(child.index(nodes, "nodes"));
    out.mesh = index_or_none(node, "mesh", out_.meshes.size(), "meshes");
    out.skin = index_or_none(node, "skin", skins, "skins");
    auto take = [&node](const char* key, auto& target) {
      if (std::optional<JsonNode> values = node.find(key)) {
        std::vector<double> numbers = values->numbers(target.size());
        std::copy(numbers.begin(), numbers.end(), target.begin());
      }
    };
    take("translation", out.translation);
    take("rotation", out.rotation);
    take("scale", out.scale);
    if (std::optional<JsonNode> matrix = node.find("matrix"))
      take("matrix", out.matrix.emplace());
    if (std::optional<JsonNode> weights = node.find("weights")) {
      if (out.mesh == kGltfNone)
        weights->fail("weights of a node without a mesh");
      out.weights = weights->numbers(out_.meshes[out.mesh].primitives[0].targets.size());
    }
    if (std::optional<JsonNode> visibility = extension(node, kVisibility)) {
      if (std::optional<JsonNode> visible = visibility->find("visible"))
        out.visible = visible->boolean();
    }
    if (std::optional<JsonNode> instancing = extension(node, kInstancingExtension)) {
      GltfInstances instances = read_instances(*instancing);
      if (out.skin != kGltfNone)
        out_.left_out.add("instances of a skin");  // whose transforms would come twice
      else if (!instancing->member("attributes").members().empty())
        out.instances = instances;
    }
    return out;
  }

  GltfInstances read_instances(const JsonNode& node) {
    GltfInstances instances;
    bool is_first = true;
    for (const auto& [name, value] : node.member("attributes").members()) {
      const uint32_t index = value.index(out_.accessors.size(), "accessors");
      const GltfAccessor& accessor = out_.accessors[index];
      if (!is_first && accessor.count != instances.count)
        value.fail("has " + std::to_string(accessor.count) + " elements, but another attribute " +
                   std::to_string(instances.count));
      instances.count = accessor.count;
      is_first = false;
      uint32_t* place = name == "TRANSLATION" ? &instances.translations
                        : name == "ROTATION"  ? &instances.rotations
                        : name == "SCALE"     ? &instances.scales
                                              : nullptr;
      if (!place)
        continue;  // what an application adds
      const uint32_t components = place == &instances.rotations ? 4 : 3;
      if (accessor.components != components)
        value.fail("has " + std::to_string(accessor.components) + " components; " +
                   std::to_string(components) + " are expected");
      *place = index;
    }
    return instances;
  }

  /// Sets the parents; every node has at most one, and none is its own ancestor.
  void check_hierarchy(const std::vector<JsonNode>& nodes) {
    for (uint32_t n = 0; n < out_.nodes.size(); ++n) {
      for (size_t i = 0; i < out_.nodes[n].children.size(); ++i) {
        uint32_t& parent = out_.nodes[out_.nodes[n].children[i]].parent;
        if (parent != kGltfNone)
          nodes[n]
              .member("children")
              .elements()[i]
              .fail("node " + std::to_string(out_.nodes[n].children[i]) +
                    " is also a child of node " + std::to_string(parent));
        parent = n;
      }
    }
    // A node that no root reaches is in a cycle or below one.
    std::vector<uint32_t> open;
    std::vector<bool> reached(out_.nodes.size());
    for (uint32_t n = 0; n < out_.nodes.size(); ++n) {
      if (out_.nodes[n].parent == kGltfNone)
        open.push_back(n);
    }
    while (!open.empty()) {
      const uint32_t n = open.back();
      open.pop_back();
      reached[n] = true;
      open.insert(open.end(), out_.nodes[n].children.begin(), out_.nodes[n].children.end());
    }
    auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost != reached.end())
      nodes[static_cast<size_t>(lost - reached.begin())].fail(
          "the node is cyclic: it is among its own ancestors, or below such a node");
  }

  GltfSkin read_skin(const JsonNode& node) {
    GltfSkin skin;
    for (const JsonNode& joint : node.member("joints").elements())
      skin.joints.push_back(joint.index(out_.nodes.size(), "nodes"));
    if (skin.joints.empty())
      node.fail("the skin has no joint");
    skin.inverse_binds =
        index_or_none(node, "inverseBindMatrices", out_.accessors.size(), "accessors");
    if (skin.inverse_binds != kGltfNone) {
      const GltfAccessor& accessor = out_.accessors[skin.inverse_binds];
      if (accessor.components != 16 || accessor.count < skin.joints.size())
        node.member("inverseBindMatrices")
            .fail("/accessors/" + std::to_string(skin.inverse_binds) +
                  " does not hold a matrix for "
                  "each of the " +
                  std::to_string(skin.joints.size()) + " joints");
    }
    return skin;
  }

  /// The default scene, else the first; a document without scenes shows all its nodes.
  void read_scene() {
    const std::vector<JsonNode> scenes = root_.elements("scenes");
    uint32_t scene = index_or_none(root_, "scene", scenes.size(), "scenes");
    if (scenes.empty()) {
      for (uint32_t n = 0; n < out_.nodes.size(); ++n) {
        if (out_.nodes[n].parent == kGltfNone)
          out_.roots.push_back(n);
      }
      return;
    }
    std::vector<bool> seen(out_.nodes.size());
    for (const JsonNode& node : scenes[scene == kGltfNone ? 0 : scene].elements("nodes")) {
      const uint32_t root = node.index(out_.nodes.size(), "nodes");
      if (out_.nodes[root].parent != kGltfNone)
        node.fail("node " + std::to_string(root) + " is not a root: it is a child of node " +
                  std::to_string(out_.nodes[root].parent));
      if (seen[root])
        node.fail("node " + std::to_string(root) + " is listed twice");
      seen[root] = true;
      out_.roots.push_back(root);
    }
  }

  GltfSampler read_sampler(const JsonNode& node) {
    GltfSampler sampler;
    sampler.input = node.member("input").index(out_.accessors.size(), "accessors");
    sampler.output = node.member("output").index(out_.accessors.size(), "accessors");
    if (std::optional<JsonNode> interpolation = node.find("interpolation")) {
      const std::string name = interpolation->text();
      if (name == "STEP")
        sampler.interpolation = GltfInterpolation::kStep;
      else if (name == "CUBICSPLINE")
        sampler.interpolation = GltfInterpolation::kCubicSpline;
      else if (name != "LINEAR")
        interpolation->fail("'" + shown(name) + "' is not a known interpolation");
    }
    const GltfAccessor& input = out_.accessors[sampler.input];
    if (input.components != 1 || input.count == 0 ||
        (input.type != GltfComponent::kFloat && input.type != GltfComponent::kHalf))
      node.member("input").fail("/accessors/" + std::to_string(sampler.input) +
                                " does not hold times: floats, at least one");
    return sampler;
  }

  /// A list of names and times in seconds; entries of another form mean something else.
  static void read_events(const JsonNode& extras, GltfAnimation& animation) {
    try {
      for (const JsonNode& event : extras.elements("events")) {
        NamedTime read{event.member("name").text(), event.member("time").number()};
        animation.events.push_back(std::move(read));
      }
    } catch (const Error&) {
      animation.events.clear();
    }
  }

  GltfAnimation read_animation(const JsonNode& node) {
    GltfAnimation animation;
    animation.name = text_or_empty(node, "name");
    for (const JsonNode& sampler : node.member("samplers").elements())
      animation.samplers.push_back(read_sampler(sampler));
    for (const JsonNode& channel : node.member("channels").elements())
      read_channel(channel, animation);
    if (std::optional<JsonNode> extras = node.find("extras")) {
      try {
        animation.rate = extras->member("anicodec").member("rate").text();
      } catch (const Error&) {
        animation.rate.clear();  // extras of others mean nothing here
      }
      read_events(*extras, animation);
    }
    return animation;
  }

  /// Targets that move no vertex are left out.
  void read_channel(const JsonNode& node, GltfAnimation& animation) {
    constexpr std::pair<std::string_view, GltfPath> kPaths[] = {
        {"translation", GltfPath::kTranslation},
        {"rotation", GltfPath::kRotation},
        {"scale", GltfPath::kScale},
        {"weights", GltfPath::kWeights},
        {"extensions/KHR_node_visibility/visible", GltfPath::kVisibility}};
    GltfChannel channel;
    channel.sampler = node.member("sampler").index(animation.samplers.size(), "samplers");
    const JsonNode target = node.member("target");
    channel.node = index_or_none(target, "node", out_.nodes.size(), "nodes");
    std::string path = target.member("path").text();
    std::vector<uint32_t> nodes;
    if (std::optional<JsonNode> pointer = extension(target, kPointer); pointer && path == "pointer")
      nodes = nodes_of(pointer->member("pointer"), path, channel.element);
    else if (channel.node != kGltfNone)
      nodes = {channel.node};
    const auto* found = std::find_if(std::begin(kPaths), std::end(kPaths),
                                     [&](const auto& p) { return p.first == path; });
    if (found == std::end(kPaths))
      return;
    channel.path = found->second;
    for (const uint32_t n : nodes) {
      channel.node = n;
      check_channel(node, channel, animation.samplers[channel.sampler]);
      animation.channels.push_back(channel);
    }
  }

  /// The nodes that a pointer moves, the path of what it moves there, and of one weight its number. None
  /// for pointers to what moves no vertex, which is listed as left out.
  std::vector<uint32_t> nodes_of(const JsonNode& pointer, std::string& path, uint32_t& element) {
    constexpr std::string_view kNodes = "/nodes/", kMeshes = "/meshes/", kWeights = "weights/";
    const std::string text = pointer.text();
    const bool is_mesh = text.starts_with(kMeshes);
    if (!is_mesh && !text.starts_with(kNodes)) {
      out_.left_out.add("animation of " + shown(text.substr(0, text.find('/', 1))));
      return {};
    }
    uint32_t number = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] =
        std::from_chars(text.data() + (is_mesh ? kMeshes : kNodes).size(), end, number);
    if (error != std::errc() || last == end || *last != '/' ||
        number >= (is_mesh ? out_.meshes.size() : out_.nodes.size()))
      pointer.fail("'" + shown(text) + "' leads to no property of a " +
                   (is_mesh ? "mesh" : "node"));
    path.assign(last + 1, end);
    if (path.starts_with(kWeights)) {
      const auto [after, fault] =
          std::from_chars(path.data() + kWeights.size(), path.data() + path.size(), element);
      if (fault != std::errc() || after != path.data() + path.size())
        pointer.fail("'" + shown(text) + "' leads to no weight");
      path = "weights";
    }
    if (!is_mesh)
      return {number};
    std::vector<uint32_t> nodes;
    for (uint32_t n = 0; n < out_.nodes.size() && path == "weights"; ++n) {
      if (out_.nodes[n].mesh == number && out_.nodes[n].weights.empty())
        nodes.push_back(n);
    }
    return nodes;
  }

  void check_channel(const JsonNode& node, const GltfChannel& channel, const GltfSampler& sampler) {
    const GltfNode& target = out_.nodes[channel.node];
    const GltfAccessor& output = out_.accessors[sampler.output];
    uint64_t values = out_.accessors[sampler.input].count;
    if (sampler.interpolation == GltfInterpolation::kCubicSpline)
      values *= 3;
    uint32_t components = channel.path == GltfPath::kRotation ? 4 : 3;
    if (channel.path == GltfPath::kWeights) {
      const size_t targets =
          target.mesh == kGltfNone ? 0 : out_.meshes[target.mesh].primitives[0].targets.size();
      if (targets == 0)
        node.fail("animates weights of node " + std::to_string(channel.node) +
                  ", whose mesh has no morph target");
      if (channel.element == kGltfNone)
        values *= targets;
      else if (channel.element >= targets)
        node.fail("animates weight " + std::to_string(channel.element) + " of node " +
                  std::to_string(channel.node) + ", whose mesh has " + std::to_string(targets) +
                  " morph targets");
      components = 1;
    } else if (channel.path == GltfPath::kVisibility) {
      if (sampler.interpolation != GltfInterpolation::kStep)
        node.fail("visibility changes by STEP alone");
      components = 1;
    } else if (target.matrix) {
      node.fail("animates node " + std::to_string(channel.node) + ", which has a matrix");
    }
    if (output.components != components || output.count != values)
      node.fail("/accessors/" + std::to_string(sampler.output) + " has " +
                std::to_string(output.count) + " elements of " + std::to_string(output.components) +
                " components; " + std::to_string(values) + " of " + std::to_string(components) +
                " are expected");
  }

  const GltfContainer& container_;
  JsonReadings readings_;
  JsonNode root_;
  const GltfResolver& resolve_;
  uint64_t memory_limit_, memory_left_;
  bool allow_outside_;
  GltfDocument out_;
};

}  // namespace

uint32_t size_of(GltfComponent component) {
  switch (component) {
    case GltfComponent::kInt8:
    case GltfComponent::kUint8:
      return 1;
    case GltfComponent::kInt16:
    case GltfComponent::kUint16:
    case GltfComponent::kHalf:
      return 2;
    case GltfComponent::kUint32:
    case GltfComponent::kFloat:
      return 4;
  }
  return 0;
}

GltfDocument parse_gltf_document(std::string_view bytes, std::string_view name,
                                 const GltfResolver& resolve, uint64_t memory_limit,
                                 bool allow_outside) {
  const GltfContainer container = open_gltf(bytes, name);
  GltfDocument document = Reader(container, name, resolve, memory_limit, allow_outside).read();
  document.bytes += bytes.size();
  return document;
}

void fail_gltf(const GltfDocument& document, const std::string& path, const std::string& reason) {
  fail_input(document.name, path + ": " + reason);
}

}  // namespace anicodec::tools
