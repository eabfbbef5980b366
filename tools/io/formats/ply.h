// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_PLY_H_
#define ANICODEC_TOOLS_IO_FORMATS_PLY_H_

#include "tools/io/base/mesh.h"
#include "tools/io/formats/ply_attributes.h"
#include "tools/io/formats/ply_corners.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

struct FileFormat;

/// Reads PLY 1.0: ascii, binary_little_endian and binary_big_endian. Takes x, y, z of element
/// vertex (any number type) and the list vertex_indices or vertex_index of element face (any
/// integer types); `details`, where given, receives the other numbers of the vertices, see
/// PlyAttributes, and of the faces, see PlyCorners. All other properties and elements are skipped by
/// their declared types, and with details named as left out. In ascii
/// files each element stands on a line of its own. Throws Error(kInput), for ascii bodies with the
/// line.
void parse_ply(std::string_view bytes, std::string_view name, Mesh& mesh,
               MeshDetails* details = nullptr);

/// Appends a PLY of one frame, binary_little_endian or ascii; coordinates read back to the same
/// floats. `properties`, where given, are those of the vertices beside their positions, which are of double from an `origin`.
void append_ply(const Polygons& polygons, std::span<const float> positions, bool ascii,
                std::string& out, const PlyProperties* properties = nullptr,
                const Point& origin = {});

extern const FileFormat kPly;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_PLY_H_
