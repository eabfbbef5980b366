// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_SCENE_H_
#define ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_SCENE_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/gltf.h"

#include <string>

namespace anicodec::tools {

/// Bakes a scene of any format that assimp reads (FBX, Collada, 3DS ...), in the way of
/// parse_gltf(), triangulated; frames of MD2 and MD3 are taken as they are. Up axis and unit are
/// those that an FBX states, else unknown. Throws Error(kInput), Error(kUnsupported) in a build
/// without assimp.
MeshSequence load_assimp(const std::string& path, const GltfOptions& options);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_SCENE_H_
