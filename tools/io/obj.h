// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_OBJ_H_
#define ANICODEC_TOOLS_IO_OBJ_H_

#include "tools/io/mesh.h"

#include <span>
#include <string>
#include <string_view>

namespace anicodec::tools {

/// Reads Wavefront OBJ: vertices and polygons, in the file's order and number. Faces may be v, v/t,
/// v//n or v/t/n with positive or negative indices and may precede their vertices; numbers after x
/// y z (w or a colour) are read and dropped. All other statements of the format are skipped by
/// name. Throws Error(kInput) "name:line: reason" for anything else.
void parse_obj(std::string_view text, std::string_view name, Mesh& mesh);

/// Appends an OBJ of one frame; coordinates read back to the same floats.
void append_obj(const Polygons& polygons, std::span<const float> positions, std::string& out);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_OBJ_H_
