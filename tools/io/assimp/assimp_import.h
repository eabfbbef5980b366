// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The function of the plug-in with all of assimp, which is loaded only for a file that needs it.
#ifndef ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_IMPORT_H_
#define ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_IMPORT_H_

#include <cstddef>
#include <cstdint>

namespace anicodec::tools {

constexpr const char* kAssimpPlugin = "anicodec_assimp.so";
constexpr const char* kAssimpFunction = "anicodec_import_with_assimp";

/// Takes bytes that are gone afterwards.
using TakeBytes = void (*)(void* user, const char* bytes, size_t size);

/// Reads a file with assimp, which may crash: to be called by run_guarded(). Each stored frame of a
/// file (`frames`, of MD2; 0: none) is a scene. Other files are read only in the folder of this
/// one, unless `allow_outside`. Returns 0, and gives for each scene a size as uint64_t in native
/// order and a GLB. After a fault it returns 1, and gives a text.
using ImportWithAssimp = int (*)(const char* path, uint32_t frames, int allow_outside, void* user,
                                 TakeBytes take);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_IMPORT_H_
