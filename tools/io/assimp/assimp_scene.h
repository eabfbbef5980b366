// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_SCENE_H_
#define ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_SCENE_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/gltf.h"

#include <string>
#include <vector>

namespace anicodec::tools {

struct FileFormat;

/// Bakes a scene of any format that assimp reads (Collada, 3DS ...), in the way of
/// parse_gltf(), triangulated; frames of MD2 are taken as they are. Up axis and unit are unknown. Throws Error(kInput), Error(kUnsupported) in a build
/// without assimp.
MeshSequence load_assimp(const std::string& path, const GltfOptions& options);

/// Animations of such a scene as clips, see parse_gltf_clips(). Stored frames are one clip without
/// names; throws Error(kUsage) for names of them.
std::vector<MeshSequence> load_assimp_clips(const std::string& path, const GltfOptions& options,
                                            const std::vector<std::string>& names);

extern const FileFormat kAssimp;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ASSIMP_ASSIMP_SCENE_H_
