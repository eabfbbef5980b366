// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_MOVING_GLB_H_
#define ANICODEC_TOOLS_IO_GLTF_MOVING_GLB_H_

#include "tools/io/gltf/gltf.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// The surface that viewers show which do not know the extension: that of the clip's first frame.
struct StillSurface {
  std::vector<float> positions;  ///< vertices x 3, in the order of parse_gltf()
  std::vector<float> normals;    ///< the same, or empty
};

/// A glTF document as a GLB in which what parse_gltf() bakes with these options moves by a clip, the bytes
/// of an .anic file with the vertices in that order: extension ANIC_mesh_animation, see
/// spec/gltf-extension.md; texture coordinates and colours that the clip has move, too. Materials, textures, images, cameras, lights, nodes, extras and
/// extensions stay; skins, morph targets, and channels of nodes that carry nothing any more go, and
/// with them what only they referred to. Images and buffers are taken into the file, buffer views
/// decompressed. `options.note` is told what is lost. Throws as parse_gltf().
std::string write_moving_glb(std::string_view bytes, std::string_view name,
                             const GltfResolver& resolve, const GltfOptions& options,
                             const StillSurface& still, std::string_view clip);

/// The clip of a GLB with that extension; nothing for files of any other kind. Throws Error(kInput)
/// where the extension is not as it should be, Error(kUnsupported) for several clips.
std::optional<std::string> clip_of_glb(std::string_view bytes, std::string_view name);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_MOVING_GLB_H_
