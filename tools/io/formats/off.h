// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_OFF_H_
#define ANICODEC_TOOLS_IO_FORMATS_OFF_H_

#include "tools/io/base/mesh.h"

#include <span>
#include <string>
#include <string_view>

namespace anicodec::tools {

struct FileFormat;

/// Reads ascii Geomview OFF: header OFF with any of the prefixes ST (texture coordinates), C
/// (colours) and N (normals), whose numbers are read and dropped, as are the colours of faces.
/// Comments (#) and blank lines may stand anywhere, the counts may follow the header on its line;
/// 4OFF, nOFF and binary OFF are refused. Throws Error(kInput) "name:line: reason".
void parse_off(std::string_view text, std::string_view name, Mesh& mesh);

/// Appends an OFF of one frame, its positions from a local origin; coordinates read back to the same floats.
void append_off(const Polygons& polygons, std::span<const float> positions, std::string& out,
                const Point& origin = {});

extern const FileFormat kOff;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_OFF_H_
