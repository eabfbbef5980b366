// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_FORMAT_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_FORMAT_H_

#include "tools/io/base/load_options.h"
#include "tools/io/gltf/gltf.h"
#include "tools/io/gltf/gltf_material.h"
#include "tools/io/gltf/moving_glb.h"

#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

struct FileFormat;

/// Options of reading as those of a scene.
GltfOptions gltf_options(const LoadOptions& options);

/// A glTF scene in one file with its clip as an extension, see write_moving_glb(): `clip` is that of
/// load_sequence() with the same options.
std::string carry_clip(const std::string& scene, const LoadOptions& options,
                       const StillSurface& still, std::string_view clip);

/// The images inside a glTF scene. Throws as load_sequence().
std::vector<GltfImage> load_images(const std::string& path);

extern const FileFormat kGltf, kGlb;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_FORMAT_H_
