// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_WRITE_OPTIONS_H_
#define ANICODEC_TOOLS_IO_BASE_WRITE_OPTIONS_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/progress.h"

#include <cstdint>
#include <vector>

namespace anicodec::tools {

struct GltfImage;

struct WriteOptions {
  bool overwrite = false;     ///< replace existing outputs instead of refusing
  bool ascii = false;         ///< PLY and STL as text
  bool step = false;          ///< GLB: frames stand until the next instead of moving to it
  bool normals = false;       ///< Alembic: those of every corner in every frame
  bool group_faces = false;   ///< OBJ: faces object by object, and in each material by material
  uint32_t first_number = 0;  ///< of frame files
  const std::vector<GltfImage>* images = nullptr;  ///< GLB: those that materials name by "#name"
  Progress progress = {};                          ///< stage "writing"
  /// Attributes in the form of those of the clip; empty: those of the clip.
  AttributeSource attributes = {};
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_WRITE_OPTIONS_H_
