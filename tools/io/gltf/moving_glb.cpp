// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/moving_glb.h"

#include "codec/sequence/error.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/text_cursor.h"
#include "tools/io/gltf/glb_buffer.h"
#include "tools/io/gltf/gltf_bake.h"
#include "tools/io/gltf/gltf_container.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <span>

#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "ANIC_mesh_animation";
constexpr const char* kLights = "KHR_lights_punctual";

/// Extensions whose references to accessors and buffer views are known here: most have none.
bool is_understood(const std::string& extension) {
  constexpr std::string_view kFamilies[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_"};
  constexpr std::string_view kOthers[] = {kExtension,
                                          kDracoExtension,
                                          kMeshoptExtensions[0],
                                          kMeshoptExtensions[1],
                                          "KHR_accessor_float16",
                                          kInstancingExtension,
                                          kLights,
                                          "EXT_lights_image_based",
                                          "KHR_animation_pointer",
                                          "KHR_mesh_quantization",
                                          "KHR_node_visibility",
                                          "KHR_xmp_json_ld"};
  return std::ranges::find(kOthers, extension) != std::end(kOthers) ||
         std::ranges::any_of(
             kFamilies, [&](std::string_view family) { return extension.starts_with(family); });
}

/// The member of an object, or of an object in it; null where there is none.
Json* find(Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? nullptr : &*found;
}

Json* find_extension(Json& object, const char* name) {
  Json* extensions = find(object, "extensions");
  return extensions ? find(*extensions, name) : nullptr;
}

void erase_extension(Json& object, const char* name) {
  if (Json* extensions = find(object, "extensions")) {
    extensions->erase(name);
    if (extensions->empty())
      object.erase("extensions");
  }
}

template <typename Visit>
void each(Json& object, const char* key, Visit visit) {
  if (Json* items = find(object, key)) {
    for (Json& item : *items)
      visit(item);
  }
}

template <typename Visit>
void visit_member(Json& object, const char* key, Visit visit) {
  if (Json* value = find(object, key))
    visit(*value);
}

/// Every reference to an accessor.
template <typename Visit>
void visit_accessors(Json& document, Visit visit) {
  each(document, "meshes", [&](Json& mesh) {
    each(mesh, "primitives", [&](Json& primitive) {
      each(primitive, "attributes", visit);
      visit_member(primitive, "indices", visit);
      each(primitive, "targets", [&](Json& target) {
        for (Json& accessor : target)
          visit(accessor);
      });
    });
  });
  each(document, "skins", [&](Json& skin) { visit_member(skin, "inverseBindMatrices", visit); });
  each(document, "animations", [&](Json& animation) {
    each(animation, "samplers", [&](Json& sampler) {
      visit_member(sampler, "input", visit);
      visit_member(sampler, "output", visit);
    });
  });
  each(document, "nodes", [&](Json& node) {
    if (Json* instances = find_extension(node, kInstancingExtension))
      each(*instances, "attributes", visit);
  });
}

/// Every reference to a buffer view.
template <typename Visit>
void visit_views(Json& document, Visit visit) {
  each(document, "accessors", [&](Json& accessor) {
    visit_member(accessor, "bufferView", visit);
    if (Json* sparse = find(accessor, "sparse")) {
      visit_member(sparse->at("indices"), "bufferView", visit);
      visit_member(sparse->at("values"), "bufferView", visit);
    }
  });
  each(document, "images", [&](Json& image) { visit_member(image, "bufferView", visit); });
  each(document, "meshes", [&](Json& mesh) {
    each(mesh, "primitives", [&](Json& primitive) {
      if (Json* draco = find_extension(primitive, kDracoExtension))
        visit_member(*draco, "bufferView", visit);
    });
  });
  if (Json* moving = find_extension(document, kExtension))
    each(*moving, "files", [&](Json& file) { visit_member(file, "bufferView", visit); });
}

/// Leaves out the elements of an array that nothing refers to. `visit` goes through the references.
template <typename Visit>
void compact(Json& document, const char* key, Visit visit) {
  Json* items = find(document, key);
  if (!items)
    return;
  std::vector<size_t> place(items->size(), 0);
  visit([&](Json& reference) { place[reference.get<size_t>()] = 1; });
  Json kept = Json::array();
  for (size_t i = 0; i < place.size(); ++i) {
    if (place[i] == 0)
      continue;
    place[i] = kept.size();
    kept.push_back(std::move((*items)[i]));
  }
  visit([&](Json& reference) { reference = place[reference.get<size_t>()]; });
  if (kept.empty())
    document.erase(key);
  else
    *items = std::move(kept);
}

std::string mime_of(std::string_view image) {
  constexpr std::pair<std::string_view, const char*> kBeginnings[] = {
      {"\x89PNG", "image/png"}, {"\xFF\xD8\xFF", "image/jpeg"}, {"\xABKTX 20", "image/ktx2"}};
  for (const auto& [begin, mime] : kBeginnings) {
    if (image.starts_with(begin))
      return mime;
  }
  return image.starts_with("RIFF") && image.substr(8).starts_with("WEBP") ? "image/webp" : "";
}

class MovingGlb {
 public:
  MovingGlb(std::string_view bytes, std::string_view name, const GltfResolver& resolve,
            const GltfOptions& options)
      : container_(open_gltf(bytes, name)),
        name_(name),
        resolve_(resolve),
        options_(options),
        source_(
            parse_gltf_document(bytes, name, resolve, options.memory_limit, options.allow_outside)),
        bake_(source_, options),
        document_(container_.document),
        old_accessors_(source_.accessors.size()),
        old_views_(source_.views.size()) {}

  std::string finish(const StillSurface& still, std::string_view clip) {
    if (find_extension(document_, kExtension))
      fail_input(std::string(name_), std::string("has the extension ") + kExtension + " already");
    move_meshes(still);
    filter_animations();
    document_["extensions"][kExtension]["files"] =
        Json::array({{{"bufferView", old_views_ + buffer_.add_bytes(clip)}}});
    take_images();
    add_buffer();
    drop_unused();
    lay_out();
    list_extensions();
    return pack_glb(document_.dump(-1, ' ', false, Json::error_handler_t::replace), binary_);
  }

 private:
  void note(const std::string& text) const {
    if (options_.note)
      options_.note(text);
  }

  size_t accessor(size_t added) const { return old_accessors_ + added; }

  /// Gives what is baked nodes of their own, which nothing moves, and takes it from the old ones.
  void move_meshes(const StillSurface& still) {
    const std::vector<GltfBaked> baked = bake_.primitives();
    Json& nodes = document_["nodes"];
    Json made = Json::array();
    for (size_t first = 0, end = 0; first < baked.size(); first = end) {
      while (end < baked.size() && baked[end].node == baked[first].node)
        ++end;
      const std::span own(baked.data() + first, end - first);
      Json& node = nodes[own[0].node];
      Json mesh = document_["meshes"][own[0].mesh], rest = mesh;
      mesh["primitives"] = Json::array();
      for (const GltfBaked& one : own)
        mesh["primitives"].push_back(moved(one, still));
      mesh.erase("weights");
      if (Json* extras = find(mesh, "extras"); extras && extras->is_object())
        extras->erase("targetNames");
      Json shown{{"mesh", document_["meshes"].size()}};
      if (const Json* name = find(node, "name") ? find(node, "name") : find(mesh, "name"))
        shown["name"] = *name;
      document_["meshes"].push_back(std::move(mesh));
      made.push_back(std::move(shown));
      leave(node, std::move(rest), own);
    }
    Json added = Json::array();
    for (Json& node : made) {
      added.push_back(nodes.size());
      nodes.push_back(std::move(node));
    }
    if (added.size() > 1) {
      nodes.push_back({{"name", "moving"}, {"children", added}});
      added = {nodes.size() - 1};
    }
    show(added);
    compact(document_, "meshes", [&](auto visit) {
      each(document_, "nodes", [&](Json& node) { visit_member(node, "mesh", visit); });
    });
    compact(document_, "skins", [&](auto visit) {
      each(document_, "nodes", [&](Json& node) { visit_member(node, "skin", visit); });
    });
  }

  /// Leaves a node what of its mesh is not baked: points and lines.
  void leave(Json& node, Json mesh, std::span<const GltfBaked> baked) {
    Json kept = Json::array();
    for (size_t p = 0; p < mesh["primitives"].size(); ++p) {
      if (std::ranges::none_of(baked, [p](const GltfBaked& one) { return one.primitive == p; }))
        kept.push_back(mesh["primitives"][p]);
    }
    if (kept.empty()) {
      for (const char* key : {"mesh", "skin", "weights"})
        node.erase(key);
      erase_extension(node, kInstancingExtension);
      return;
    }
    mesh["primitives"] = std::move(kept);
    node["mesh"] = document_["meshes"].size();
    document_["meshes"].push_back(std::move(mesh));
  }

  void show(const Json& added) {
    if (!find(document_, "scenes")) {
      document_["scenes"] = Json::array({{{"nodes", source_.roots}}});
      document_["scene"] = 0;
    }
    const size_t scene = document_.value("scene", size_t{0});
    Json& roots = document_["scenes"][scene]["nodes"];
    roots.insert(roots.end(), added.begin(), added.end());
  }

  Json moved(const GltfBaked& baked, const StillSurface& still) {
    const GltfVertices& vertices = baked.geometry->vertices;
    Json primitive = document_["meshes"][baked.mesh]["primitives"][baked.primitive];
    primitive.erase("targets");
    Json attributes = Json::object();
    const bool draco = find_extension(primitive, kDracoExtension) != nullptr;
    for (const auto& [name, old] : primitive["attributes"].items()) {
      if (name == "POSITION" || name == "NORMAL" || name == "TANGENT" ||
          name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"))
        continue;
      if (!draco)
        attributes[name] = old;
      else if (vertices.uvs.contains(name))
        attributes[name] = floats(vertices.uvs.at(name), 2);
      else if (vertices.colours.contains(name))
        attributes[name] = floats(vertices.colours.at(name), 4);
      else
        note("attribute " + shown(name) + " of a primitive that Draco coded is left out");
    }
    if (draco) {
      erase_extension(primitive, kDracoExtension);
    }
    if (draco || baked.turned) {
      std::vector<uint32_t> corners = baked.geometry->triangles;
      for (size_t i = 0; baked.turned && i < corners.size(); i += 3)
        std::swap(corners[i + 1], corners[i + 2]);
      primitive["mode"] = 4;
      primitive["indices"] = accessor(buffer_.add_indices(corners, vertices.count));
    }
    if (baked.owns_vertices) {
      const auto part = [&](const std::vector<float>& all) {
        return std::span(all).subspan(size_t{3} * baked.first_vertex, size_t{3} * vertices.count);
      };
      Json& surface = surfaces_[baked.first_vertex];
      surface["POSITION"] =
          accessor(buffer_.add_floats(part(still.positions), 3, GlbTarget::kVertices, true));
      if (!still.normals.empty() && !vertices.base.normals.empty())
        surface["NORMAL"] =
            accessor(buffer_.add_floats(part(still.normals), 3, GlbTarget::kVertices, false));
    }
    attributes.update(surfaces_.at(baked.first_vertex));
    primitive["attributes"] = std::move(attributes);
    primitive["extensions"][kExtension] = {{"file", 0}, {"firstVertex", baked.first_vertex}};
    return primitive;
  }

  size_t floats(const std::vector<float>& values, size_t components) {
    return accessor(buffer_.add_floats(values, components, GlbTarget::kVertices, false));
  }

  /// Nodes with something that a channel may move: cameras, lights, meshes and joints that are left.
  std::vector<bool> nodes_of_use() {
    Json& nodes = document_["nodes"];
    std::vector<bool> used(nodes.size());
    const auto add = [&](size_t node) {
      for (size_t n = node; n < source_.nodes.size() && !used[n]; n = source_.nodes[n].parent)
        used[n] = true;
    };
    for (size_t n = 0; n < source_.nodes.size(); ++n) {
      Json& node = nodes[n];
      if (find(node, "camera") || find(node, "mesh") || find_extension(node, kLights))
        add(n);
    }
    each(document_, "skins", [&](Json& skin) {
      for (const Json& joint : skin["joints"])
        add(joint.get<size_t>());
    });
    return used;
  }

  /// Leaves out channels of nodes that carry nothing, and of weights of meshes that are gone.
  void filter_animations() {
    const std::vector<bool> used = nodes_of_use();
    Json kept = Json::array();
    size_t left_out = 0;
    each(document_, "animations", [&](Json& animation) {
      Json channels = Json::array();
      for (Json& channel : animation["channels"]) {
        if (is_of_use(channel["target"], used))
          channels.push_back(std::move(channel));
        else
          ++left_out;
      }
      if (channels.empty())
        return;
      animation["channels"] = std::move(channels);
      compact(animation, "samplers", [&](auto visit) {
        for (Json& channel : animation["channels"])
          visit(channel["sampler"]);
      });
      kept.push_back(std::move(animation));
    });
    if (kept.empty())
      document_.erase("animations");
    else
      document_["animations"] = std::move(kept);
    if (left_out > 0)
      note(std::to_string(left_out) +
           (left_out == 1
                ? " animation channel is in the clip or moves nothing, and is left out"
                : " animation channels are in the clip or move nothing, and are left out"));
  }

  bool is_of_use(Json& target, const std::vector<bool>& used) {
    constexpr std::string_view kNodes = "/nodes/";
    std::string path = target.value("path", "");
    size_t node = target.value("node", used.size());
    if (Json* pointer = find_extension(target, "KHR_animation_pointer")) {
      const std::string text = pointer->value("pointer", "");
      if (text.starts_with("/meshes/"))
        return false;  // weights of a mesh are in the clip
      if (!text.starts_with(kNodes))
        return true;
      const auto [last, error] =
          std::from_chars(text.data() + kNodes.size(), text.data() + text.size(), node);
      path = error == std::errc() && *last == '/' ? last + 1 : "";
      path = path.substr(0, path.find("/"));
    }
    if (node >= used.size())
      return false;
    return path == "weights" ? document_["nodes"][node].contains("mesh") : used[node];
  }

  /// Files beside the document become views of the buffer.
  void take_images() {
    const JsonNode root(container_.document, name_);
    const std::vector<JsonNode> images = root.elements("images");
    for (size_t i = 0; i < images.size(); ++i) {
      const std::optional<JsonNode> uri = images[i].find("uri");
      if (!uri)
        continue;
      const std::string text = uri->text();
      std::string bytes;
      if (is_data_uri(text)) {
        const std::vector<char> decoded = decode_data_uri(text, *uri);
        bytes.assign(decoded.begin(), decoded.end());
      } else {
        const std::string path = path_of_uri(text, *uri, options_.allow_outside);
        try {
          bytes = resolve_(path);
        } catch (const Error& e) {
          note(std::string(e.what()) + "; the image stays a reference");
          continue;
        }
      }
      Json& image = document_["images"][i];
      const std::string mime = mime_of(bytes);
      if (mime.empty()) {
        note("image " + shown(text.substr(0, 80)) +
             " is of a kind that a buffer cannot hold, and stays a reference");
        continue;
      }
      image.erase("uri");
      image["mimeType"] = mime;
      image["bufferView"] = old_views_ + buffer_.add_bytes(bytes);
    }
  }

  /// Appends what was made; `buffer` of a view is its number until lay_out().
  void add_buffer() {
    GlbBuffer::Json made;
    buffer_.describe_in(made);
    Json& views = document_["bufferViews"];
    for (size_t v = 0; v < views.size(); ++v) {
      Json& view = views[v];
      for (const char* extension : kMeshoptExtensions)
        erase_extension(view, extension);
      view["buffer"] = v;
      bytes_.push_back(source_.views[v].bytes);
    }
    for (const GlbBuffer::Json& view : made["bufferViews"]) {
      Json copy(view);
      copy["buffer"] = bytes_.size();
      bytes_.push_back(
          std::string_view(buffer_.bytes())
              .substr(view["byteOffset"].get<size_t>(), view["byteLength"].get<size_t>()));
      views.push_back(std::move(copy));
    }
    for (const GlbBuffer::Json& one : made["accessors"]) {
      Json copy(one);
      visit_member(copy, "bufferView", [&](Json& view) { view = view.get<size_t>() + old_views_; });
      document_["accessors"].push_back(std::move(copy));
    }
  }

  void drop_unused() {
    std::string unknown;
    each(document_, "extensionsUsed", [&](Json& extension) {
      if (!is_understood(extension.get<std::string>()))
        unknown += (unknown.empty() ? "" : ", ") + shown(extension.get<std::string>());
    });
    if (!unknown.empty()) {
      note("all data of the source stays in the file, as what " + unknown +
           " refers to is not known");
      return;
    }
    compact(document_, "accessors", [&](auto visit) { visit_accessors(document_, visit); });
    compact(document_, "bufferViews", [&](auto visit) { visit_views(document_, visit); });
  }

  void lay_out() {
    each(document_, "bufferViews", [&](Json& view) {
      const std::string_view bytes = bytes_[view["buffer"].get<size_t>()];
      binary_.resize((binary_.size() + 3) / 4 * 4);
      view["buffer"] = 0;
      view["byteOffset"] = binary_.size();
      view["byteLength"] = bytes.size();
      binary_ += bytes;
    });
    document_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  }

  /// Names those that are in the file now.
  void list_extensions() {
    const std::string meshes = document_["meshes"].dump(), nodes = document_["nodes"].dump();
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
      Json* names = find(document_, list);
      if (!names)
        continue;
      Json kept = Json::array();
      for (const Json& one : *names) {
        if (one != kMeshoptExtensions[0] && one != kMeshoptExtensions[1] &&
            (one != kDracoExtension || meshes.find(kDracoExtension) != std::string::npos) &&
            (one != kInstancingExtension || nodes.find(kInstancingExtension) != std::string::npos))
          kept.push_back(one);
      }
      if (kept.empty())
        document_.erase(list);
      else
        *names = std::move(kept);
    }
    document_["extensionsUsed"].push_back(kExtension);
  }

  const GltfContainer container_;
  std::string_view name_;
  const GltfResolver& resolve_;
  const GltfOptions& options_;
  const GltfDocument source_;
  const GltfBake bake_;
  Json document_;
  const size_t old_accessors_, old_views_;
  GlbBuffer buffer_;
  std::map<uint32_t, Json> surfaces_;  ///< attributes, by the first vertex
  std::vector<std::string_view> bytes_;
  std::string binary_;
};

}  // namespace

std::string write_moving_glb(std::string_view bytes, std::string_view name,
                             const GltfResolver& resolve, const GltfOptions& options,
                             const StillSurface& still, std::string_view clip) {
  return MovingGlb(bytes, name, resolve, options).finish(still, clip);
}

std::optional<std::string> clip_of_glb(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with("glTF"))
    return std::nullopt;
  const GltfContainer container = open_gltf(bytes, name);
  const JsonNode root(container.document, name);
  const std::optional<JsonNode> extensions = root.find("extensions");
  const std::optional<JsonNode> moving = extensions ? extensions->find(kExtension) : std::nullopt;
  if (!moving)
    return std::nullopt;
  const std::vector<JsonNode> files = moving->elements("files");
  if (files.size() != 1)
    throw Error(ErrorKind::kUnsupported, std::string(name) + ": has " +
                                             std::to_string(files.size()) + " clips in " +
                                             kExtension + "; one is read");
  const std::vector<JsonNode> views = root.elements("bufferViews");
  const JsonNode& view = views[files[0].member("bufferView").index(views.size(), "buffer views")];
  const uint64_t whole = container.binary ? container.binary->size() : 0;
  const uint64_t size = view.member("byteLength").whole(whole);
  const std::optional<JsonNode> begin = view.find("byteOffset");
  const uint64_t offset = begin ? begin->whole(whole - size) : 0;
  if (view.member("buffer").whole(UINT32_MAX) != 0 || size == 0)
    view.fail("the clip is not in the binary chunk of the file");
  return std::string(container.binary->substr(offset, size));
}

}  // namespace anicodec::tools
