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
  kAssimp,
  kAlembic
};

/// Kind by extension, in any case of letters.
FileKind kind_of(const std::string& path);

/// True for what can be written.
inline bool is_output(FileKind kind) {
  return kind != FileKind::kUnknown && kind != FileKind::kGltf && kind != FileKind::kAssimp &&
         kind != FileKind::kAlembic;
}

inline bool is_cache(FileKind kind) {
  return kind == FileKind::kPc2 || kind == FileKind::kMdd;
}

/// True for scenes, of which one file is a whole clip.
inline bool is_scene(FileKind kind) {
  return kind == FileKind::kGltf || kind == FileKind::kGlb || kind == FileKind::kAssimp;
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_FILE_KIND_H_
