// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_MESH_H_
#define ANICODEC_TOOLS_IO_BASE_MESH_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/base/left_kinds.h"
#include "tools/io/base/local_origin.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// One mesh as a file holds it. The parsers clear and refill it, so that a sequence of frames
/// reuses its memory.
struct Mesh {
  Polygons polygons;
  FrameArray positions;  ///< vertices x 3, row-major
  LocalOrigin origin;    ///< of the positions
  LeftKinds left_out;    ///< of all frames that were read, those with details

  size_t vertex_count() const { return positions.size() / 3; }

  void clear() {
    polygons.offsets.assign(1, 0);
    polygons.corners.clear();
    positions.clear();
  }
};

/// Limits of the sequence model, checked by every reader.
inline constexpr uint64_t kMaxVertices = (uint64_t{1} << 31) - 1;
inline constexpr uint64_t kMaxFrames = (uint64_t{1} << 24) - 1;
inline constexpr uint64_t kMaxCorners = (uint64_t{1} << 32) - 1;

/// Throws Error(kInput) "name: text".
[[noreturn]] void fail_input(std::string_view name, const std::string& text);

/// Throws Error(kUsage) "name: text".
[[noreturn]] void fail_usage(std::string_view name, const std::string& text);

/// Throws Error(kInput) unless the mesh has a vertex and its counts are within the limits.
void check_size(const Mesh& mesh, std::string_view name);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_MESH_H_
