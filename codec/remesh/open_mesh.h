// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Between our meshes and half-edge meshes of OpenMesh's kind, whose headers stay in the sources.
#ifndef ANICODEC_CODEC_REMESH_OPEN_MESH_H_
#define ANICODEC_CODEC_REMESH_OPEN_MESH_H_

#include "codec/sequence/error.h"
#include "codec/surface/surface.h"
#include "codec/surface/surface_topology.h"

#include <array>
#include <cstdint>
#include <vector>

namespace anicodec {

/// Adds the vertices and triangles of a SoundMesh to an empty mesh, with the same numbers.
template <class Mesh>
void add_triangles(const std::vector<SurfaceTopology::Triangle>& triangles,
                   const Positions& positions, Mesh* mesh) {
  const auto vertices = static_cast<size_t>(positions.rows());
  mesh->reserve(vertices, vertices + triangles.size(), triangles.size());
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    mesh->add_vertex({positions(v, 0), positions(v, 1), positions(v, 2)});
  auto handle = [](uint32_t v) { return typename Mesh::VertexHandle(static_cast<int>(v)); };
  for (const SurfaceTopology::Triangle& t : triangles) {
    if (!mesh->add_face(handle(t[0]), handle(t[1]), handle(t[2])).is_valid())
      throw Error(ErrorKind::kInternal, "a mesh was not made manifold before it was remeshed");
  }
}

/// The faces of a half-edge mesh that are left, over the vertices that they use.
struct CompactMesh {
  std::vector<SurfaceTopology::Triangle> triangles;
  std::vector<uint32_t> vertices;  ///< number in the half-edge mesh, ascending
};

template <class Mesh>
CompactMesh compact(const Mesh& mesh) {
  CompactMesh result;
  for (auto f : mesh.faces()) {  // leaves out what is deleted
    SurfaceTopology::Triangle t{};
    size_t k = 0;
    for (auto v : mesh.fv_range(f))
      t[k++] = static_cast<uint32_t>(v.idx());
    result.triangles.push_back(t);
  }
  std::vector<uint32_t> place(mesh.n_vertices(), 0);
  for (const SurfaceTopology::Triangle& t : result.triangles) {
    for (uint32_t v : t)
      place[v] = 1;
  }
  for (uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == 0)
      continue;
    place[v] = static_cast<uint32_t>(result.vertices.size());
    result.vertices.push_back(v);
  }
  for (SurfaceTopology::Triangle& t : result.triangles) {
    for (uint32_t& v : t)
      v = place[v];
  }
  return result;
}

/// The positions of some vertices of a half-edge mesh.
template <class Mesh>
Positions positions_of(const Mesh& mesh, const std::vector<uint32_t>& vertices) {
  Positions positions(static_cast<Eigen::Index>(vertices.size()), 3);
  for (size_t i = 0; i < vertices.size(); ++i) {
    const auto p = mesh.point(typename Mesh::VertexHandle(static_cast<int>(vertices[i])));
    positions.row(static_cast<Eigen::Index>(i)) << p[0], p[1], p[2];
  }
  return positions;
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_REMESH_OPEN_MESH_H_
