// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// For this room alone: it shows ufbx.
#ifndef ANICODEC_TOOLS_IO_FBX_FBX_SCENE_H_
#define ANICODEC_TOOLS_IO_FBX_FBX_SCENE_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/gltf.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <ufbx.h>

namespace anicodec::tools {

struct FreeUfbx {
  void operator()(ufbx_scene* scene) const { ufbx_free_scene(scene); }

  void operator()(ufbx_anim* anim) const { ufbx_free_anim(anim); }
};

using UfbxScene = std::unique_ptr<ufbx_scene, FreeUfbx>;
using UfbxAnim = std::unique_ptr<ufbx_anim, FreeUfbx>;

using FbxNote = std::function<void(const std::string& text)>;

inline std::string text_of(ufbx_string s) {
  return {s.data, s.length};
}

/// Throws Error(kInput) with what ufbx says.
[[noreturn]] void fail_fbx(const std::string& path, const ufbx_error& error);

/// A file as ufbx reads it, right-handed with Y or Z up.
class FbxScene {
 public:
  /// Takes the meshes of the scene, or those of the name that is asked for, and notes what the file has and a clip does not.
  /// Throws Error(kInput), Error(kUsage) where there is none of the name.
  FbxScene(const std::string& path, const GltfOptions& options, const FbxNote& note);

  const std::string& path() const { return path_; }

  const ufbx_scene& scene() const { return *scene_; }

  /// Nodes with meshes to be baked.
  const std::vector<const ufbx_node*>& nodes() const { return nodes_; }

  UpAxis up() const;

  double metres_per_unit() const { return static_cast<double>(scene_->settings.unit_meters); }

  /// Whether a cache of geometry moves a mesh.
  bool has_caches() const;

  /// The scene at a time, transforms and weights; `anim` null: without animation.
  UfbxScene at(const ufbx_anim* anim, double time) const;

  /// For readers of caches of geometry: opens those in the folder of the file, or all.
  ufbx_open_file_cb files() const;

 private:
  UfbxScene load(bool turn_axes) const;
  void select(const FbxNote& note);
  void note_left_out(const FbxNote& note) const;
  static bool open_file(void* user, ufbx_stream* stream, const char* path, size_t length,
                        const ufbx_open_file_info* info);

  std::string path_;
  const GltfOptions& options_;
  UfbxScene scene_;
  UfbxAnim still_;
  std::vector<const ufbx_node*> nodes_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FBX_FBX_SCENE_H_
