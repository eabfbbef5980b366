// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/prediction/mesh_graph.h"

namespace anicodec {

Status MeshGraph::init(const uint32_t* triangles, size_t triangle_count, size_t vertex_count) {
  if (vertex_count > size_t{1} << 30 || triangle_count > UINT32_MAX / 6)
    return Status::kLimit;
  for (size_t i = 0; i < 3 * triangle_count; ++i)
    if (triangles[i] >= vertex_count)
      return Status::kIndexRange;
  const size_t n = vertex_count;
  start_.assign(n + 1, 0);
  for (size_t i = 0; i < 3 * triangle_count; ++i)
    start_[triangles[i]] += 2;
  uint32_t sum = 0;
  for (uint32_t& s : start_) {
    sum += s;
    s = sum;  // the end of each vertex's edges; filling moves it to the beginning
  }
  adjacent_.resize(sum);
  for (size_t t = 0; t < triangle_count; ++t) {
    const uint32_t* c = triangles + 3 * t;
    for (int k = 0; k < 3; ++k) {
      uint32_t& at = start_[c[k]];
      adjacent_[--at] = c[(k + 1) % 3];
      adjacent_[--at] = c[(k + 2) % 3];
    }
  }
  Vector<uint32_t> met(n, 0);  // one more than the vertex that met this one last
  uint32_t size = 0, used = 0;
  for (uint32_t v = 0; v < n; ++v) {
    const uint32_t first = start_[v], last = start_[v + 1];
    start_[v] = size;
    met[v] = v + 1;
    for (uint32_t e = first; e < last; ++e) {
      const uint32_t u = adjacent_[e];
      if (met[u] != v + 1) {
        met[u] = v + 1;
        adjacent_[size++] = u;
      }
    }
    used += size > start_[v];
  }
  start_[n] = size;
  is_dense_ = anicodec::is_dense(size, used);
  adjacent_.resize(is_dense_ ? 0 : size);
  Vector<uint32_t>(adjacent_).swap(adjacent_);  // shrink_to_fit() hides that there is no memory
  return Status::kOk;
}

}  // namespace anicodec
