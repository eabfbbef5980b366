// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/file_kind.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

namespace anicodec::tools {

FileKind kind_of(const std::string& path) {
  constexpr std::pair<std::string_view, FileKind> kKinds[] = {
      {".obj", FileKind::kObj},    {".ply", FileKind::kPly},    {".off", FileKind::kOff},
      {".stl", FileKind::kStl},    {".pc2", FileKind::kPc2},    {".mdd", FileKind::kMdd},
      {".gltf", FileKind::kGltf},  {".glb", FileKind::kGlb},    {".fbx", FileKind::kFbx},
      {".dae", FileKind::kAssimp}, {".md2", FileKind::kAssimp}, {".md3", FileKind::kMd3},
      {".3ds", FileKind::kAssimp}, {".b3d", FileKind::kAssimp}, {".ms3d", FileKind::kAssimp},
      {".smd", FileKind::kAssimp}, {".x", FileKind::kAssimp},   {".lwo", FileKind::kAssimp},
      {".abc", FileKind::kAlembic}};
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const auto& [known, kind] : kKinds) {
    if (extension == known)
      return kind;
  }
  return FileKind::kUnknown;
}

}  // namespace anicodec::tools
