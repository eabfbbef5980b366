// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_format.h"

#include "tools/io/base/file_format.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/gltf/glb_output.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

namespace anicodec::tools {
namespace {

/// Reads files by their names relative to a scene.
GltfResolver resolver_of(const std::string& scene) {
  return [folder = std::filesystem::path(scene).parent_path()](const std::string& name) {
    std::string file;
    read_file((folder / name).string(), file);
    return file;
  };
}

std::string refuse_file(const std::string& name) {
  fail_input(name, "a scene from the standard input has no other files");
}

MeshSequence read_scene(const InputFile& file, const LoadOptions& options) {
  std::string read;
  if (!file.bytes)
    read_file(file.name, read);
  const std::string& bytes = file.bytes ? *file.bytes : read;
  if (options.note && !file.bytes && clip_of_glb(bytes, file.name))
    options.note(file.name +
                 " moves by a clip inside, which decode writes; as a scene it stands still");
  const GltfOptions scene = gltf_options(options);
  const GltfResolver resolve = file.bytes ? refuse_file : resolver_of(file.name);
  return load_animations(
      options, [&] { return parse_gltf(bytes, file.name, resolve, scene); },
      [&] { return parse_gltf_clips(bytes, file.name, resolve, scene, options.clips); });
}

void write_scene(const OutputClip& output) {
  const auto& [path, clip, frames, source, options] = output;
  AtomicFile file(path, options.overwrite);
  std::vector<Attribute> all = options.attributes ? options.attributes(0) : clip.attributes;
  for (uint32_t f = 1; options.attributes && f < clip.frame_count; ++f)
    add_frame(options.attributes(f), f, all);
  std::span<const GltfImage> images;
  if (options.images)
    images = *options.images;
  GlbOutput glb(clip, options.step, images, &all);
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    std::vector<Attribute> attributes;
    if (options.attributes)
      attributes = options.attributes(f);
    else if (f == 0)
      attributes = clip.attributes;
    glb.add_frame(frames(f), attributes);
  }
  file.write(glb.finish(times_of(clip)));
  file.commit();
}

}  // namespace

GltfOptions gltf_options(const LoadOptions& options) {
  GltfOptions scene{.rate = options.rate, .mesh = options.mesh, .clip = options.clip};
  scene.memory_limit = options.memory;
  scene.allow_outside = options.allow_outside;
  scene.scene_stays = options.scene_stays;
  scene.origin = options.origin.value_or(Point());
  scene.progress = options.progress;
  scene.note = options.note;
  return scene;
}

std::string carry_clip(const std::string& scene, const LoadOptions& options,
                       const StillSurface& still, std::string_view clip) {
  std::string bytes;
  read_file(scene, bytes);
  return write_moving_glb(bytes, scene, resolver_of(scene), gltf_options(options), still, clip);
}

std::vector<GltfImage> load_images(const std::string& path) {
  std::string bytes;
  read_file(path, bytes);
  std::vector<GltfImage> images =
      parse_gltf_document(bytes, path, resolver_of(path), half_of_machine()).images;
  std::erase_if(images, [](const GltfImage& image) { return image.name.empty(); });
  return images;
}

const FileFormat kGltf = {.name = "glTF",
                          .extensions = ".gltf",
                          .role = FileRole::kScene,
                          .find_mark =
                              [](std::string_view bytes) {
                                const size_t begin = bytes.find_first_not_of(" \t\r\n");
                                return begin != bytes.npos && bytes[begin] == '{' ? begin
                                                                                  : bytes.npos;
                              },
                          .read_clip = read_scene,
                          .carries_clip = true};

const FileFormat kGlb = {
    .name = "GLB",
    .extensions = ".glb",
    .role = FileRole::kScene,
    .find_mark = [](std::string_view bytes) { return bytes.starts_with("glTF") ? 0 : bytes.npos; },
    .read_clip = read_scene,
    .write_clip = write_scene,
    .carries_clip = true,
    .has_room_for_origin = true};

}  // namespace anicodec::tools
