// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CORPUS_BUILD_H_
#define ANICODEC_CORPUS_BUILD_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/random.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace anicodec::corpus {

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}

inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// p turned about the axis through the origin (any length but 0) by an angle in radians.
Vec3 rotated(const Vec3& p, const Vec3& axis, double angle);

/// 0 below 0, 1 above 1, 3 x^2 - 2 x^3 between.
double smooth_step(double x);

/// A rest pose and its faces.
struct Mesh {
  std::vector<Vec3> vertices;
  Polygons polygons;

  uint32_t add(const Vec3& p) {
    vertices.push_back(p);
    return static_cast<uint32_t>(vertices.size() - 1);
  }

  void triangle(uint32_t a, uint32_t b, uint32_t c);
  void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
  /// Adds the vertices and faces of another mesh, sharing none.
  void append(const Mesh& other);
};

/// columns x rows vertices on [0, 1]^2 at z = 0, row-major, two triangles per cell.
Mesh grid(uint32_t columns, uint32_t rows);

/// A closed tube around the z axis, of `rings` rings of `sectors` vertices from z = 0 to z = length
/// and a vertex in the middle of each cap; triangles.
Mesh tube(uint32_t rings, uint32_t sectors, double radius, double length);

/// The surface of [-1, 1]^3 with n x n quads a side, 6 n^2 + 2 vertices.
Mesh quad_box(uint32_t n);

/// Every polygon cut into a fan from its first corner.
Mesh triangulated(const Mesh& mesh);

/// The position of a vertex at a time in seconds.
using Motion = std::function<Vec3(uint32_t vertex, const Vec3& rest, double time)>;

/// Samples a motion at 24 frames a second. Coordinates become multiples of unit / 2^16, unit a
/// power of two of about the size of the clip, so that the last bits of the mathematics library do
/// not show; they are exact in float32 up to 2^8 units. Cost: one call of `motion` per vertex and
/// frame.
MeshSequence animate(const Mesh& mesh, uint32_t frames, double unit, const Motion& motion);

}  // namespace anicodec::corpus

#endif  // ANICODEC_CORPUS_BUILD_H_
