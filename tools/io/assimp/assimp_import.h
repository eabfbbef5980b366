// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The code of the child process: all of assimp, and nothing else.
#ifndef ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_IMPORT_H_
#define ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_IMPORT_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// A file as assimp read it: which way is up, metres of a unit, and a GLB for each scene.
struct AssimpImport {
  UpAxis up = UpAxis::kUnknown;
  double metres_per_unit = 0;  ///< 0: unknown
  std::vector<std::string> scenes;
};

/// Reads a file with assimp, which may crash: to be called by run_guarded(). Of a file with stored
/// frames (MD2, MD3; 0: none) each is a scene. Other files are read only in the folder of this one,
/// unless `allow_outside`. Throws Error(kInput).
AssimpImport import_with_assimp(const std::string& path, uint32_t frames, bool allow_outside);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_IMPORT_H_
