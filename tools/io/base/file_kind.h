// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_FILE_KIND_H_
#define ANICODEC_TOOLS_IO_BASE_FILE_KIND_H_

#include <string>

namespace anicodec::tools {

enum class FileKind {
  kUnknown,
  kObj,
  kPly,
  kOff,
  kStl,
  kPc2,
  kMdd,
  kGltf,
  kGlb,
  kFbx,
  kMd3,
  kAssimp,
  kAlembic
};

/// Kind by extension, in any case of letters.
FileKind kind_of(const std::string& path);

/// True for what can be written.
inline bool is_output(FileKind kind) {
  return kind != FileKind::kUnknown && kind != FileKind::kGltf && kind != FileKind::kFbx &&
         kind != FileKind::kMd3 && kind != FileKind::kAssimp;
}

inline bool is_cache(FileKind kind) {
  return kind == FileKind::kPc2 || kind == FileKind::kMdd;
}

/// True for scenes, which can be sampled at any rate.
inline bool is_scene(FileKind kind) {
  return kind == FileKind::kGltf || kind == FileKind::kGlb || kind == FileKind::kFbx ||
         kind == FileKind::kAssimp;
}

/// True for files of which one is a whole clip: scenes, and archives of frames with their meshes.
inline bool is_whole_clip(FileKind kind) {
  return is_scene(kind) || kind == FileKind::kAlembic || kind == FileKind::kMd3;
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_FILE_KIND_H_
