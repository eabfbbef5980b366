// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_MD3_H_
#define ANICODEC_TOOLS_IO_FORMATS_MD3_H_

#include "codec/sequence/mesh_sequence.h"

#include <functional>
#include <string>
#include <string_view>

namespace anicodec::tools {

struct FileFormat;

/// Reads a model of Quake III (MD3, version 15) with all its frames: surfaces are parts, one after the other, with the
/// shader that they name first as their material; Z is up. Faces, clockwise in the file, are turned, texture
/// coordinates count v upwards, normals are those of the first frame. The rate is not in the file: 10 is assumed. `note`
/// is told of what is left out. Throws Error(kInput) "name: place: reason".
MeshSequence parse_md3(std::string_view bytes, const std::string& name,
                       const std::function<void(const std::string& text)>& note = {});

extern const FileFormat kMd3;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_MD3_H_
