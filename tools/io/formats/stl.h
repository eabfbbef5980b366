// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_STL_H_
#define ANICODEC_TOOLS_IO_FORMATS_STL_H_

#include "tools/io/base/mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

struct FileFormat;

/// Reads STL, binary or ascii (several solids are one mesh), as a soup: triangles x 3 corners x 3
/// floats, degenerate ones included. Normals are dropped. A file is binary when
/// its size fits the count of triangles in its header, else ascii. Throws Error(kInput).
void parse_stl(std::string_view bytes, std::string_view name, std::vector<float>& soup,
               LocalOrigin& origin, LeftKinds& left_out);

/// Appends a binary or ascii STL of one frame: polygons, triangles best, as fans from their first
/// corner, unit normals (zero for degenerate triangles). Unused vertices are lost. Ascii has positions from a local origin.
void append_stl(const Polygons& polygons, std::span<const float> positions, bool ascii,
                std::string& out, const Point& origin = {});

/// Makes shared vertices of the corners of an STL sequence. Corners at exactly the same place in
/// frame 0 are one vertex, numbered by first occurrence, and must stay together in all other
/// frames. Without welding every corner is a vertex.
class StlWeld {
 public:
  StlWeld(std::span<const float> first_soup, std::string first_name, bool weld);

  uint32_t vertex_count() const { return static_cast<uint32_t>(corner_of_vertex_.size()); }

  Polygons polygons() const;

  /// Appends the vertices of a frame, vertex_count() x 3. Throws Error(kInput) when the number of
  /// triangles differs or corners that are one vertex lie apart.
  void append_vertices(std::span<const float> soup, std::string_view name,
                       FrameArray& positions) const;

 private:
  std::string first_name_;
  std::vector<uint32_t> vertex_of_corner_;
  std::vector<uint32_t> corner_of_vertex_;  ///< first corner of each vertex
};

extern const FileFormat kStl;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_STL_H_
