// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Meshes and questions to them that the tests of remeshing share.
#ifndef ANICODEC_TESTS_CODEC_REMESH_REMESH_MESHES_H_
#define ANICODEC_TESTS_CODEC_REMESH_REMESH_MESHES_H_

#include "codec/remesh/sound_mesh.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "codec/surface/surface_frame.h"
#include "codec/surface/surface_topology.h"
#include "tests/codec/massage_meshes.h"

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {

inline SurfaceFrame frame_of(const TestMesh& mesh,
                             const Eigen::Vector3d& by = Eigen::Vector3d::Zero()) {
  SurfaceFrame frame;
  for (const SurfaceTopology::Triangle& t : mesh.topology.triangles)
    frame.polygons.add(t);
  for (uint32_t i = 0; i < mesh.topology.vertex_count; ++i) {
    for (int k = 0; k < 3; ++k)
      frame.positions.push_back(static_cast<float>(mesh.positions(i, k) + by[k]));
  }
  return frame;
}

inline SurfaceFrame mesh_of(FrameArray positions,
                            std::initializer_list<std::vector<uint32_t>> faces) {
  SurfaceFrame frame;
  frame.positions = std::move(positions);
  for (const std::vector<uint32_t>& face : faces)
    frame.polygons.add(face);
  return frame;
}

/// The quads of the cube [0, 1]^3, shifted.
inline SurfaceFrame cube(float x = 0) {
  return mesh_of(
      {x, 0, 0, x + 1, 0, 0, x + 1, 1, 0, x, 1, 0, x, 0, 1, x + 1, 0, 1, x + 1, 1, 1, x, 1, 1},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// Triangles around a hub at the height 1, closed by those around a second one at -1.
inline SurfaceFrame double_cone(uint32_t sides) {
  SurfaceFrame frame;
  frame.positions = {0, 0, 1, 0, 0, -1};
  for (uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * 3.14159265358979 * i / sides;
    for (double x : {std::cos(angle), std::sin(angle), 0.0})
      frame.positions.push_back(static_cast<float>(x));
    const uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
    frame.polygons.add(std::array<uint32_t, 3>{0, a, b});
    frame.polygons.add(std::array<uint32_t, 3>{1, b, a});
  }
  return frame;
}

inline SurfaceFrame both(const SurfaceFrame& a, const SurfaceFrame& b) {
  SurfaceFrame sum = a;
  const auto shift = static_cast<uint32_t>(a.positions.size() / 3);
  for (size_t p = 0; p < b.polygons.size(); ++p) {
    std::vector<uint32_t> face;
    for (uint32_t v : b.polygons[p])
      face.push_back(v + shift);
    sum.polygons.add(face);
  }
  sum.positions.insert(sum.positions.end(), b.positions.begin(), b.positions.end());
  return sum;
}

inline size_t vertices_of(const SurfaceFrame& mesh) {
  return mesh.positions.size() / 3;
}

inline SurfaceTopology topology_of(const SurfaceFrame& mesh) {
  return {fan_triangles(mesh.polygons), static_cast<uint32_t>(vertices_of(mesh))};
}

/// Every vertex is used and lies within one fan, every edge has one face or two wound alike.
inline void expect_manifold(const SurfaceFrame& mesh, bool closed) {
  const SoundMesh sound = sound_mesh(single_frame(mesh));
  EXPECT_FALSE(sound.repairs.any());
  EXPECT_EQ(sound.source.size(), vertices_of(mesh));
  EXPECT_EQ(topology_of(mesh).has_boundary(), !closed);
}

inline double area_of(const SurfaceFrame& mesh) {
  const SurfaceTopology topology = topology_of(mesh);
  double area = 0;
  for (const SurfaceTopology::Triangle& t : topology.triangles)
    area += area_normal(positions_of(mesh.positions), t).norm() / 2;
  return area;
}

inline bool has_vertex(const SurfaceFrame& mesh, const std::array<float, 3>& place) {
  for (size_t v = 0; v < vertices_of(mesh); ++v) {
    if (std::equal(place.begin(), place.end(), mesh.positions.begin() + 3 * static_cast<long>(v)))
      return true;
  }
  return false;
}

inline void expect_error(const std::function<void()>& work, ErrorKind kind,
                         const std::string& text) {
  try {
    work();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), kind);
    EXPECT_NE(std::string(e.what()).find(text), std::string::npos) << e.what();
  }
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_REMESH_REMESH_MESHES_H_
