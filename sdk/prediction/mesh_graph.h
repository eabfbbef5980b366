// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PREDICTION_MESH_GRAPH_H_
#define ANICODEC_SDK_PREDICTION_MESH_GRAPH_H_

#include "format/memory.h"
#include "format/status.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace anicodec {

/// Whether a graph has so many edges, each counted from both sides, that the order of the vertices
/// replaces it (normative): surfaces have a mean degree of about six.
inline bool is_dense(size_t adjacent, size_t vertices) {
  constexpr uint64_t kMaxMeanDegree = 16;
  return adjacent > kMaxMeanDegree * vertices;
}

/// The edges of a mesh, each once: what the orders of all its segments take from the connectivity.
class MeshGraph {
 public:
  /// kIndexRange: a triangle uses a vertex that does not exist; kLimit: too many triangles or
  /// vertices for 32-bit offsets. Cost: O(vertices + triangles).
  Status init(const uint32_t* triangles, size_t triangle_count, size_t vertex_count);

  size_t vertex_count() const { return start_.size() - 1; }

  /// Vertex v has adjacent()[start()[v]] .. [start()[v + 1] - 1], unless the graph is dense.
  const Vector<uint32_t>& start() const { return start_; }

  const Vector<uint32_t>& adjacent() const { return adjacent_; }

  /// Gives the edges away.
  void take(Vector<uint32_t>* start, Vector<uint32_t>* adjacent) && {
    *start = std::move(start_);
    *adjacent = std::move(adjacent_);
  }

  /// So many edges that the order replaces the graph; they are not kept.
  bool is_dense() const { return is_dense_; }

 private:
  Vector<uint32_t> start_{0}, adjacent_;
  bool is_dense_ = false;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_MESH_GRAPH_H_
