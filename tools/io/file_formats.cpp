// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/file_formats.h"

#include "tools/io/alembic/alembic_format.h"
#include "tools/io/assimp/assimp_scene.h"
#include "tools/io/fbx/fbx.h"
#include "tools/io/formats/cache_output.h"
#include "tools/io/formats/md3.h"
#include "tools/io/formats/obj.h"
#include "tools/io/formats/off.h"
#include "tools/io/formats/ply.h"
#include "tools/io/formats/stl.h"
#include "tools/io/gltf/gltf_format.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr const FileFormat* kFormats[] = {&kObj,  &kPly, &kOff, &kStl, &kPc2,     &kMdd,
                                          &kGltf, &kGlb, &kFbx, &kMd3, &kAlembic, &kAssimp};

bool has_role(const std::string& path, FileRole role) {
  const FileFormat* format = format_of(path);
  return format && format->role == role;
}

}  // namespace

std::span<const FileFormat* const> file_formats() {
  return kFormats;
}

const FileFormat* format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const FileFormat* format : kFormats) {
    if (fmt::format(" {} ", format->extensions).find(" " + extension + " ") != std::string::npos)
      return format;
  }
  return nullptr;
}

const FileFormat& format_of_bytes(std::string_view bytes) {
  const FileFormat* found = kFormats[0];
  size_t first = std::string_view::npos;
  for (const FileFormat* format : kFormats) {
    const size_t place = format->find_mark ? format->find_mark(bytes) : first;
    if (place < first) {
      found = format;
      first = place;
    }
  }
  return *found;
}

std::string list_formats(bool (*is_meant)(const FileFormat& format), std::string_view last) {
  std::vector<std::string> names;
  for (const FileFormat* format : kFormats) {
    if (is_meant(*format))
      names.push_back(format->extensions.find(' ') == std::string_view::npos
                          ? std::string(format->extensions)
                          : fmt::format("scenes of {}", format->name));
  }
  const std::string end = names.back();
  names.pop_back();
  return fmt::format("{}{}{}", fmt::join(names, ", "), names.empty() ? "" : last, end);
}

std::string output_names() {
  std::string clips, frames;
  for (const FileFormat* format : kFormats) {
    if (format->write_clip)
      clips += fmt::format("x{}, ", format->extensions);
    if (format->frame_writer)
      frames += (frames.empty() ? "." : "|") + std::string(format->extensions.substr(1));
  }
  return clips + "dir/frame_%04d" + frames;
}

std::string mesh_names() {
  std::string names;
  for (const FileFormat* format : kFormats) {
    if (format->frame_writer)
      names += fmt::format("{}x{}", names.empty() ? "" : ", ", format->extensions);
  }
  return names;
}

bool is_cache(const std::string& path) {
  return has_role(path, FileRole::kCache);
}

bool is_scene(const std::string& path) {
  return has_role(path, FileRole::kScene);
}

bool is_whole_clip(const std::string& path) {
  return is_scene(path) || has_role(path, FileRole::kArchive);
}

bool carries_clip(const std::string& path) {
  const FileFormat* format = format_of(path);
  return format && format->carries_clip;
}

bool is_scene_output(const std::string& path) {
  return carries_clip(path) && format_of(path)->is_written();
}

}  // namespace anicodec::tools
