// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/assimp/assimp_scene.h"

#include "codec/sequence/error.h"
#include "tools/io/assimp/assimp_plugin.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/base/file_format.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/printable.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/gltf/gltf_format.h"
#include "tools/io/guard/guard_message.h"
#include "tools/io/guard/guarded_call.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>
#include <utility>

namespace anicodec::tools {
namespace {

/// How many frames an MD2 holds, as its header says; 0 for others.
uint32_t stored_frames(const std::string& path) {
  constexpr uint64_t kPlace = 40;
  const ByteSource source = file_source(path);
  if (source.size < kPlace + 4)
    return 0;
  char head[4], count[4];
  source.read(0, head);
  source.read(kPlace, count);
  return std::string_view(head, 4) == "IDP2" ? load<uint32_t>(count, std::endian::little) : 0;
}

bool is_collada(const std::string& path) {
  return path.size() >= 4 && (path.ends_with(".dae") || path.ends_with(".DAE"));
}

/// The value of an attribute of the tag at a place; empty without.
std::string attribute_of_tag(std::string_view text, size_t tag, std::string_view name) {
  const std::string_view inside = text.substr(tag, text.find('>', tag) - tag);
  const size_t at = inside.find(" " + std::string(name) + "=");
  if (at == inside.npos)
    return {};
  const size_t quote = at + name.size() + 2;
  return quote < inside.size() ? std::string(inside.substr(
                                     quote + 1, inside.find(inside[quote], quote + 1) - quote - 1))
                               : "";
}

/// Notes on what assimp makes of Collada that is not in it: it takes the shapes of a morph controller for no mesh, and keys of
/// every kind for linear ones.
void check_collada(const std::string& path, const GltfOptions& options) {
  std::string text;
  read_file(path, text);
  std::string controller;
  for (size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
    const std::string_view here = std::string_view(text).substr(at + 1);
    if (here.starts_with("controller ")) {
      controller = attribute_of_tag(text, at, "id");
    } else if (here.starts_with("morph ") && text.find("\"#" + controller + "\"") != text.npos) {
      throw Error(ErrorKind::kUnsupported,
                  path + ": the morph controller '" + printable(controller) +
                      "' cannot be read; export the clip as glTF, FBX or Alembic");
    } else if (here.starts_with("Name_array") && options.note) {
      const size_t begin = text.find('>', at), end = text.find('<', begin);
      const std::string names =
          begin == text.npos || end == text.npos ? "" : text.substr(begin, end - begin);
      for (const char* kind : {"BEZIER", "STEP", "HERMITE", "BSPLINE", "CARDINAL"}) {
        if (names.find(kind) == names.npos)
          continue;
        return options.note(
            path + ": keys of interpolation " + kind +
            " are read as linear ones; export with a key at each frame, or as glTF or FBX");
      }
    }
  }
}

std::string imported(ImportWithAssimp import, const std::string& path, uint32_t frames,
                     bool allow_outside) {
  std::string bytes;
  const auto take = [](void* user, const char* from, size_t size) {
    static_cast<std::string*>(user)->assign(from, size);
  };
  if (import(path.c_str(), frames, allow_outside ? 1 : 0, &bytes, take) != 0)
    throw Error(ErrorKind::kInput, bytes);
  return bytes;
}

/// Adds a stored frame to those before it.
void add_stored_frame(MeshSequence frame, const std::string& path, MeshSequence& out) {
  if (frame.polygons != out.polygons || frame.vertex_count != out.vertex_count)
    fail_input(path, "frame " + std::to_string(out.frame_count) +
                         " has other vertices or faces than frame 0");
  out.positions.insert(out.positions.end(), frame.positions.begin(), frame.positions.end());
  ++out.frame_count;
}

/// The contents of a file.
struct AssimpFile {
  std::string bytes;
  std::vector<std::string_view> scenes;  ///< of `bytes`
};

AssimpFile read_file_by_assimp(const std::string& path, uint32_t frames,
                               const GltfOptions& options) {
  if (is_collada(path))
    check_collada(path, options);
  const GuardLimits limits = GuardLimits::for_input(file_source(path).size, options.memory_limit);
  const ImportWithAssimp import = assimp_plugin(path);
  AssimpFile file;
  file.bytes = run_guarded(path, limits,
                           [&] { return imported(import, path, frames, options.allow_outside); });
  GuardMessage in(file.bytes, path);
  while (!in.at_end())
    file.scenes.push_back(in.text());
  if (file.scenes.empty())
    fail_input(path, "holds no scene");
  return file;
}

}  // namespace

MeshSequence load_assimp(const std::string& path, const GltfOptions& options) {
  constexpr FrameRate kQuakeRate{10, 1, true};
  const uint32_t frames = stored_frames(path);
  const AssimpFile file = read_file_by_assimp(path, frames, options);
  GltfOptions one = options;
  one.flat_without_normals = false;  // a rule of glTF alone
  if (frames > 0)
    one.clip = "none";
  MeshSequence out = parse_gltf(file.scenes[0], path, {}, one);
  for (size_t i = 1; i < file.scenes.size(); ++i)
    add_stored_frame(parse_gltf(file.scenes[i], path, {}, one), path, out);
  if (frames > 0)
    out.rate = options.rate.value_or(kQuakeRate);
  return out;
}

std::vector<MeshSequence> load_assimp_clips(const std::string& path, const GltfOptions& options,
                                            const std::vector<std::string>& names) {
  if (stored_frames(path) > 0) {
    if (!names.empty())
      throw Error(ErrorKind::kUsage, path + ": has frames, and no clips");
    return {load_assimp(path, options)};
  }
  const AssimpFile file = read_file_by_assimp(path, 0, options);
  GltfOptions all = options;
  all.flat_without_normals = false;
  return parse_gltf_clips(file.scenes[0], path, {}, all, names);
}

const FileFormat kAssimp = {
    .name = "assimp",
    .extensions = ".dae .md2 .3ds .b3d .ms3d .smd .x .lwo",
    .role = FileRole::kScene,
    .read_clip = [](const InputFile& file, const LoadOptions& options) {
      const GltfOptions scene = gltf_options(options);
      return load_animations(
          options, [&] { return load_assimp(file.name, scene); },
          [&] { return load_assimp_clips(file.name, scene, options.clips); });
    }};

}  // namespace anicodec::tools
