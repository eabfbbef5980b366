// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Small surfaces that the tests of the massage share.
#ifndef ANICODEC_TESTS_CODEC_MASSAGE_MESHES_H_
#define ANICODEC_TESTS_CODEC_MASSAGE_MESHES_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/surface/surface.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {

struct TestMesh {
  SurfaceTopology topology;
  Positions positions;
};

/// n x n vertices on [0, n - 1]^2, z = height(x, y).
template <class Height>
TestMesh height_field(uint32_t n, const Height& height) {
  std::vector<uint32_t> corners;
  Positions positions(static_cast<Eigen::Index>(n) * n, 3);
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      positions.row(y * n + x) << x, y, height(x, y);
      if (x + 1 < n && y + 1 < n) {
        const uint32_t a = y * n + x, b = a + 1, c = a + n + 1, d = a + n;
        corners.insert(corners.end(), {a, b, c, a, c, d});
      }
    }
  }
  return {SurfaceTopology(corners, n * n), std::move(positions)};
}

inline TestMesh flat_sheet(uint32_t n) {
  return height_field(n, [](double, double) { return 0.0; });
}

/// A closed surface: a unit sphere of n x n quads on each side of a cube, cut into triangles.
inline TestMesh sphere(uint32_t n) {
  std::vector<Eigen::Vector3d> points;
  std::vector<uint32_t> corners;
  auto vertex = [&](Eigen::Vector3d p) {
    p = (p / n * 2 - Eigen::Vector3d::Ones()).normalized();
    for (uint32_t i = 0; i < points.size(); ++i) {
      if ((points[i] - p).norm() < 1e-9)
        return i;
    }
    points.push_back(p);
    return static_cast<uint32_t>(points.size() - 1);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t side : {0U, n}) {
      for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < n; ++j) {
          auto corner = [&](uint32_t u, uint32_t v) {
            Eigen::Vector3d p;
            p[axis] = side;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            return vertex(p);
          };
          uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                   d = corner(i, j + 1);
          if (side == 0)
            std::swap(b, d);
          corners.insert(corners.end(), {a, b, c, a, c, d});
        }
      }
    }
  }
  Positions positions(static_cast<Eigen::Index>(points.size()), 3);
  for (uint32_t i = 0; i < points.size(); ++i)
    positions.row(i) = points[i].transpose();
  return {SurfaceTopology(corners, static_cast<uint32_t>(points.size())), std::move(positions)};
}

/// Moves inner vertices of a flat sheet in its plane.
inline void shake(TestMesh* mesh, double by) {
  for (uint32_t i = 0; i < mesh->topology.vertex_count; ++i) {
    if (mesh->topology.kind[i] == VertexKind::kInner)
      mesh->positions.row(i) +=
          by * Eigen::RowVector3d(std::sin(7.0 * i), std::cos(5.0 * i + 1), 0);
  }
}

/// A sheet that turns and bends, with other noise in each frame.
inline MeshSequence bending_sheet(const TestMesh& sheet, uint32_t frames, double noise) {
  MeshSequence clip;
  clip.vertex_count = sheet.topology.vertex_count;
  clip.frame_count = frames;
  for (const SurfaceTopology::Triangle& t : sheet.topology.triangles)
    clip.polygons.add(t);
  for (uint32_t f = 0; f < frames; ++f) {
    const Eigen::AngleAxisd turn(0.3 * f, Eigen::Vector3d(1, 2, 3).normalized());
    for (uint32_t i = 0; i < clip.vertex_count; ++i) {
      Eigen::Vector3d p = row(sheet.positions, i);
      p[2] = std::sin(0.4 * f) * std::cos(0.3 * p[0]);
      p = turn * p;
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t c = 3 * i + k;
        clip.positions.push_back(
            static_cast<float>(p[k] + noise * std::sin(12.9898 * c + 78.233 * f + 0.37 * c * f)));
      }
    }
  }
  return clip;
}

/// Root of the mean squared difference of the coordinates of two clips of one size.
inline double rms_distance(const MeshSequence& a, const MeshSequence& b) {
  double sum = 0;
  for (size_t i = 0; i < a.positions.size(); ++i)
    sum += std::pow(double{a.positions[i]} - double{b.positions[i]}, 2);
  return std::sqrt(sum / static_cast<double>(a.positions.size()));
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_MASSAGE_MESHES_H_
