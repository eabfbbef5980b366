// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MSGI_FACE_GRAPH_H_
#define ANICODEC_SDK_MSGI_FACE_GRAPH_H_

#include "format/memory.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

inline constexpr uint32_t kNoIndex = UINT32_MAX;

/// Which faces of any triangle list are neighbours, by integers alone. Faces that share an edge
/// meet in a hinge; an edge of k faces has k - 1 hinges, between faces that follow one another by
/// number, so boundaries, duplicate faces and non-manifold edges need no cases. Components are
/// those of faces that share a vertex; where hinges leave one in pieces, single joins between faces
/// that share a vertex hold it together. Triangles with three equal corners are left out.
struct FaceGraph {
  struct Edge {
    uint32_t a, b;  ///< vertices, a < b
  };

  uint32_t vertex_count = 0;
  Vector<uint32_t> corners;     ///< three vertices per face
  Vector<Edge> edges;           ///< ascending
  Vector<uint32_t> face_edges;  ///< three per face, as the corners; kNoIndex when of no length
  /// Neighbours of face f are neighbours[begin[f]] .. neighbours[begin[f+1]-1], those by a join
  /// from hinge_end[f] on. A pair of faces with several hinges is listed as often.
  Vector<uint32_t> begin, hinge_end, neighbours;
  Vector<uint32_t> face_component;
  Vector<uint32_t> vertex_component;  ///< kNoIndex for vertices without face
  uint32_t component_count = 0;

  size_t face_count() const { return corners.size() / 3; }
};

/// Corners must be below vertex_count. O(faces), but for sorting the faces of each vertex.
FaceGraph make_face_graph(const uint32_t* triangles, size_t triangle_count, uint32_t vertex_count);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MSGI_FACE_GRAPH_H_
