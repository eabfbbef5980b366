// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/fbx/fbx_scene.h"

#include "codec/sequence/error.h"
#include "tools/io/base/left_kinds.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"
#include "tools/io/files/byte_source.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kMostDepth = 1024;

bool is_right_handed(const ufbx_coordinate_axes& axes) {
  // Numbers go X, -X, Y, -Y, Z, -Z.
  const int right = axes.right / 2, up = axes.up / 2, front = axes.front / 2;
  const bool negative = (axes.right % 2 + axes.up % 2 + axes.front % 2) % 2 != 0;
  const bool cyclic = up == (right + 1) % 3 && front == (up + 1) % 3;
  return cyclic != negative;
}

/// Levels of detail stand in one place: the first is shown.
bool is_other_level(const ufbx_node& node) {
  for (const ufbx_node* n = &node; n->parent != nullptr; n = n->parent) {
    if (n->parent->attrib_type == UFBX_ELEMENT_LOD_GROUP && n->parent->children.data[0] != n)
      return true;
  }
  return false;
}

/// Refuses a file of text that ends within a block, which ufbx reads as far as it goes.
void check_end_of_text(const std::string& path) {
  std::string text;
  read_file(path, text);
  size_t depth = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' || text[i] == ';')  // up to the end of a text or comment
      i = std::min(text.find(text[i] == '"' ? '"' : '\n', i + 1), text.size());
    else if (text[i] == '{')
      ++depth;
    else if (text[i] == '}' && depth > 0)
      --depth;
  }
  if (depth > 0)
    fail_input(path, "truncated: ends in a block that is not closed");
}

/// The name of elements that a clip does not keep; empty: they are kept, noted where they are met, or
/// say nothing by themselves.
std::string kind_left_out(int type) {
  switch (type) {
    case UFBX_ELEMENT_NODE:
    case UFBX_ELEMENT_MESH:
    case UFBX_ELEMENT_BONE:
    case UFBX_ELEMENT_EMPTY:
    case UFBX_ELEMENT_LOD_GROUP:
    case UFBX_ELEMENT_SKIN_DEFORMER:
    case UFBX_ELEMENT_SKIN_CLUSTER:
    case UFBX_ELEMENT_BLEND_DEFORMER:
    case UFBX_ELEMENT_BLEND_CHANNEL:
    case UFBX_ELEMENT_BLEND_SHAPE:
    case UFBX_ELEMENT_CACHE_DEFORMER:
    case UFBX_ELEMENT_CACHE_FILE:
    case UFBX_ELEMENT_MATERIAL:
    case UFBX_ELEMENT_TEXTURE:
    case UFBX_ELEMENT_VIDEO:
    case UFBX_ELEMENT_SHADER:
    case UFBX_ELEMENT_SHADER_BINDING:
    case UFBX_ELEMENT_ANIM_STACK:
    case UFBX_ELEMENT_ANIM_LAYER:
    case UFBX_ELEMENT_ANIM_VALUE:
    case UFBX_ELEMENT_ANIM_CURVE:
    case UFBX_ELEMENT_AUDIO_LAYER:
    case UFBX_ELEMENT_POSE:
    case UFBX_ELEMENT_SELECTION_NODE:
    case UFBX_ELEMENT_METADATA_OBJECT:
      return "";
    case UFBX_ELEMENT_LIGHT:
      return "light";
    case UFBX_ELEMENT_CAMERA:
    case UFBX_ELEMENT_STEREO_CAMERA:
      return "camera";
    case UFBX_ELEMENT_LINE_CURVE:
    case UFBX_ELEMENT_NURBS_CURVE:
      return "curve";
    case UFBX_ELEMENT_NURBS_SURFACE:
      return "NURBS surface";
    case UFBX_ELEMENT_PROCEDURAL_GEOMETRY:
      return "procedural geometry";
    case UFBX_ELEMENT_MARKER:
      return "marker";
    case UFBX_ELEMENT_DISPLAY_LAYER:
      return "display layer";
    case UFBX_ELEMENT_SELECTION_SET:
      return "selection set";
    case UFBX_ELEMENT_CHARACTER:
      return "character";
    case UFBX_ELEMENT_CONSTRAINT:
      return "constraint";
    case UFBX_ELEMENT_AUDIO_CLIP:
      return "audio clip";
    default:
      return "element of kind " + std::to_string(type);
  }
}

bool has_custom_properties(const ufbx_props& props) {
  return std::any_of(
      props.props.data, props.props.data + props.props.count,
      [](const ufbx_prop& prop) { return (prop.flags & UFBX_PROP_FLAG_USER_DEFINED) != 0; });
}

}  // namespace

void fail_fbx(const std::string& path, const ufbx_error& error) {
  if (error.type == UFBX_ERROR_OUT_OF_MEMORY)
    throw std::bad_alloc();
  std::string text = text_of(error.description);
  if (error.info_length > 0)
    text += " (" + std::string(error.info, error.info_length) + ")";
  fail_input(path, "ufbx: " + printable(text));
}

FbxScene::FbxScene(const std::string& path, const GltfOptions& options, const FbxNote& note)
    : path_(path), options_(options), scene_(load(false)) {
  if (scene_->metadata.ascii)
    check_end_of_text(path_);
  const ufbx_coordinate_axes& axes = scene_->settings.axes;
  const bool is_known = ufbx_coordinate_axes_valid(axes);
  if (is_known && (!is_right_handed(axes) || up() == UpAxis::kUnknown)) {
    note(path_ + ": its axes are turned to Y up, right-handed");
    scene_ = load(true);
  }
  ufbx_error error;
  still_.reset(ufbx_create_anim(scene_.get(), nullptr, &error));
  if (!still_)
    fail_fbx(path_, error);
  for (const ufbx_warning& warning :
       std::span(scene_->metadata.warnings.data, scene_->metadata.warnings.count))
    note(path_ + ": " + printable(text_of(warning.description)) +
         (warning.count > 1 ? ", " + std::to_string(warning.count) + " times" : ""));
  select(note);
  note_left_out(note);
}

UfbxScene FbxScene::load(bool turn_axes) const {
  ufbx_load_opts load = {};
  load.load_external_files = true;
  load.ignore_missing_external_files = true;
  load.generate_missing_normals = true;
  load.use_blender_pbr_material = true;
  load.skip_mesh_parts = true;
  load.ignore_embedded = true;
  load.index_error_handling = UFBX_INDEX_ERROR_HANDLING_ABORT_LOADING;
  load.node_depth_limit = kMostDepth;
  load.open_main_file_with_default = true;
  load.open_file_cb = files();
  if (turn_axes) {
    load.target_axes = ufbx_axes_right_handed_y_up;
    load.handedness_conversion_axis = UFBX_MIRROR_AXIS_X;
  }
  ufbx_error error;
  UfbxScene scene(ufbx_load_file(path_.c_str(), &load, &error));
  if (!scene)
    fail_fbx(path_, error);
  return scene;
}

ufbx_open_file_cb FbxScene::files() const {
  ufbx_open_file_cb files = {};
  files.fn = open_file;
  files.user = const_cast<FbxScene*>(this);
  return files;
}

bool FbxScene::open_file(void* user, ufbx_stream* stream, const char* path, size_t length,
                         const ufbx_open_file_info* info) {
  if (length == 0)
    return false;
  const FbxScene& scene = *static_cast<const FbxScene*>(user);
  const fs::path folder = fs::absolute(scene.path_).lexically_normal().parent_path();
  const fs::path asked = fs::absolute(std::string(path, length)).lexically_normal();
  const fs::path inner = asked.lexically_relative(folder);
  if (!scene.options_.allow_outside && (inner.empty() || *inner.begin() == ".."))
    return false;
  return ufbx_default_open_file(nullptr, stream, path, length, info);
}

UpAxis FbxScene::up() const {
  switch (scene_->settings.axes.up) {
    case UFBX_COORDINATE_AXIS_POSITIVE_Y:
      return UpAxis::kY;
    case UFBX_COORDINATE_AXIS_POSITIVE_Z:
      return UpAxis::kZ;
    default:
      return UpAxis::kUnknown;
  }
}

bool FbxScene::has_caches() const {
  return std::ranges::any_of(nodes_, [](const ufbx_node* node) {
    const ufbx_cache_deformer_list& caches = node->mesh->cache_deformers;
    return std::any_of(
        caches.data, caches.data + caches.count,
        [](const ufbx_cache_deformer* cache) { return cache->external_channel != nullptr; });
  });
}

UfbxScene FbxScene::at(const ufbx_anim* anim, double time) const {
  ufbx_error error;
  UfbxScene scene(
      ufbx_evaluate_scene(scene_.get(), anim ? anim : still_.get(), time, nullptr, &error));
  if (!scene)
    fail_fbx(path_, error);
  return scene;
}

void FbxScene::select(const FbxNote& note) {
  std::string list;
  size_t meshes = 0, other_levels = 0;
  for (const ufbx_node* node : std::span(scene_->nodes.data, scene_->nodes.count)) {
    const ufbx_mesh* mesh = node->mesh;
    if (mesh == nullptr)
      continue;
    const std::string name = text_of(node->name);
    constexpr size_t kMostListed = 20;
    if (meshes++ < kMostListed)
      list += (list.empty() ? "'" : ", '") + printable(name) + "'";
    if (!options_.mesh.empty() && options_.mesh != name && options_.mesh != text_of(mesh->name))
      continue;
    if (options_.mesh.empty() && is_other_level(*node)) {
      ++other_levels;
      continue;
    }
    if (mesh->num_triangles == 0) {
      note(path_ + ": mesh '" + printable(name) + "' has no face, and is left out");
      continue;
    }
    nodes_.push_back(node);
  }
  if (meshes == 0)
    fail_input(path_, "the scene has no mesh");
  if (nodes_.empty() && !options_.mesh.empty())
    throw Error(ErrorKind::kUsage, path_ + ": there is no mesh '" + printable(options_.mesh) +
                                       "'; the meshes are: " + list);
  if (nodes_.empty())
    fail_input(path_, "no mesh has a face");
  if (other_levels > 0)
    note(path_ + ": " + counted_kind(other_levels, "lower level") +
         " of detail left out; --mesh takes one");
}

void FbxScene::note_left_out(const FbxNote& note) const {
  const ufbx_scene& s = *scene_;
  std::map<std::string, size_t> counts;
  for (int type = 0; type < UFBX_ELEMENT_TYPE_COUNT; ++type) {
    const std::string kind = kind_left_out(type);
    if (const size_t count = s.elements_by_type[type].count; !kind.empty() && count > 0)
      counts[kind] += count;
  }
  LeftKinds kinds;
  for (const auto& [kind, count] : counts)
    kinds.add(counted_kind(count, kind));
  for (const ufbx_node* node : nodes_) {
    const ufbx_mesh& mesh = *node->mesh;
    if (has_custom_properties(node->props) || has_custom_properties(mesh.props))
      kinds.add("custom properties");
    if (mesh.edge_crease.count > 0 || mesh.vertex_crease.exists)
      kinds.add("creases");
  }
  if (!kinds.text().empty())
    note(path_ + ": not kept: " + kinds.text());
  for (const ufbx_node* node : nodes_) {
    const ufbx_mesh& mesh = *node->mesh;
    const std::string place = path_ + ": mesh '" + printable(text_of(node->name)) + "' ";
    if (mesh.subdivision_display_mode == UFBX_SUBDIVISION_DISPLAY_SMOOTH ||
        mesh.subdivision_display_mode == UFBX_SUBDIVISION_DISPLAY_HULL_AND_SMOOTH)
      note(place + "is a subdivision surface, read as its control mesh");
    if (mesh.skin_deformers.count > 1)
      note(place + "has several skins, of which the first is used");
    for (const ufbx_cache_deformer* cache :
         std::span(mesh.cache_deformers.data, mesh.cache_deformers.count)) {
      if (cache->external_channel == nullptr)
        note(place +
             "has a cache of geometry that is not found in the folder of the file, and stands as "
             "without");
    }
  }
  for (const ufbx_texture* texture : std::span(s.textures.data, s.textures.count)) {
    if (texture->has_uv_transform)
      note(path_ + ": the transform of texture '" + printable(text_of(texture->name)) +
           "' is left out");
  }
}

}  // namespace anicodec::tools
