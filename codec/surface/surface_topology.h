// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_SURFACE_TOPOLOGY_H_
#define ANICODEC_CODEC_SURFACE_SURFACE_TOPOLOGY_H_

#include "codec/sequence/mesh_sequence.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace anicodec {

/// Lists of vertices or triangles, one for each vertex, in one array.
class IndexLists {
 public:
  IndexLists() = default;

  /// From (list, item) pairs, sorted.
  IndexLists(std::span<const std::array<uint32_t, 2>> sorted, uint32_t list_count);

  std::span<const uint32_t> operator[](size_t list) const {
    return {items_.data() + first_[list], first_[list + 1] - first_[list]};
  }

 private:
  std::vector<uint32_t> first_{0};
  std::vector<uint32_t> items_;
};

enum class VertexKind : uint8_t {
  kInner,     ///< every edge at it has two triangles
  kBoundary,  ///< exactly two edges at it have one triangle, all others two
  kPinned,  ///< unused, or at an edge of three or more or of unlike oriented triangles, or at more
            ///< than two boundary edges
};

/// Who is next to whom on a triangle mesh: what moving vertices over a surface needs to know.
struct SurfaceTopology {
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  using Triangle = std::array<uint32_t, 3>;

  SurfaceTopology() = default;

  /// Triangles that repeat a vertex are left out. Cost: O(triangles log triangles). Throws
  /// Error(kInput) for a corner out of range.
  SurfaceTopology(std::span<const uint32_t> corners, uint32_t vertices);

  uint32_t vertex_count = 0;
  std::vector<Triangle> triangles;
  std::vector<Triangle> across;  ///< the triangle beyond the edge opposite to each corner, or kNone
  IndexLists ring;               ///< neighbours of each vertex, ascending
  IndexLists star;               ///< triangles around each vertex, ascending
  std::vector<VertexKind> kind;
  /// Set for boundary vertices; kNone for others.
  std::vector<std::array<uint32_t, 2>> boundary_neighbours;

  bool has_boundary() const;
};

/// The connected component of the triangles that each vertex is in; components are numbered
/// by their first vertex.
std::vector<uint32_t> components(const SurfaceTopology& topology);

/// The sides of the triangles, each once, smaller end first, ascending.
std::vector<std::array<uint32_t, 2>> edges(const SurfaceTopology& topology);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_SURFACE_TOPOLOGY_H_
