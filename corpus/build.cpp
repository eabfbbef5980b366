// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/build.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <tuple>

namespace anicodec::corpus {

Vec3 rotated(const Vec3& p, const Vec3& axis, double angle) {
  Vec3 u = (1 / std::sqrt(dot(axis, axis))) * axis;
  double c = std::cos(angle);
  return c * p + std::sin(angle) * cross(u, p) + ((1 - c) * dot(u, p)) * u;
}

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

void Mesh::triangle(uint32_t a, uint32_t b, uint32_t c) {
  const uint32_t corners[] = {a, b, c};
  polygons.add(corners);
}

void Mesh::quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const uint32_t corners[] = {a, b, c, d};
  polygons.add(corners);
}

void Mesh::append(const Mesh& other) {
  auto shift = static_cast<uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  std::vector<uint32_t> corners;
  for (size_t p = 0; p < other.polygons.size(); ++p) {
    corners.assign(other.polygons[p].begin(), other.polygons[p].end());
    for (uint32_t& v : corners)
      v += shift;
    polygons.add(corners);
  }
}

Mesh grid(uint32_t columns, uint32_t rows) {
  Mesh mesh;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      mesh.add({static_cast<double>(i) / (columns - 1), static_cast<double>(j) / (rows - 1), 0});
    }
  }
  for (uint32_t j = 0; j + 1 < rows; ++j) {
    for (uint32_t i = 0; i + 1 < columns; ++i) {
      uint32_t v = j * columns + i;
      mesh.triangle(v, v + 1, v + columns + 1);
      mesh.triangle(v, v + columns + 1, v + columns);
    }
  }
  return mesh;
}

Mesh tube(uint32_t rings, uint32_t sectors, double radius, double length) {
  Mesh mesh;
  for (uint32_t r = 0; r < rings; ++r) {
    for (uint32_t s = 0; s < sectors; ++s) {
      double angle = 2 * std::numbers::pi * s / sectors;
      mesh.add({radius * std::cos(angle), radius * std::sin(angle), length * r / (rings - 1)});
    }
  }
  uint32_t bottom = mesh.add({0, 0, 0});
  uint32_t top = mesh.add({0, 0, length});
  uint32_t last = (rings - 1) * sectors;
  for (uint32_t s = 0; s < sectors; ++s) {
    uint32_t t = (s + 1) % sectors;
    mesh.triangle(bottom, t, s);
    for (uint32_t r = 0; r + 1 < rings; ++r) {
      uint32_t ring = r * sectors;
      mesh.triangle(ring + s, ring + t, ring + sectors + t);
      mesh.triangle(ring + s, ring + sectors + t, ring + sectors + s);
    }
    mesh.triangle(top, last + s, last + t);
  }
  return mesh;
}

Mesh quad_box(uint32_t n) {
  Mesh mesh;
  std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint32_t> index;
  auto vertex = [&](std::array<uint32_t, 3> p) {
    auto [at, is_new] =
        index.try_emplace({p[0], p[1], p[2]}, static_cast<uint32_t>(mesh.vertices.size()));
    if (is_new)
      mesh.add({2.0 * p[0] / n - 1, 2.0 * p[1] / n - 1, 2.0 * p[2] / n - 1});
    return at->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (bool far_side : {false, true}) {
      for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < n; ++j) {
          std::array<uint32_t, 3> p{};
          p[axis] = far_side ? n : 0;
          auto corner = [&](uint32_t di, uint32_t dj) {
            p[u] = i + di;
            p[v] = j + dj;
            return vertex(p);
          };
          uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (far_side)
            mesh.quad(a, b, c, d);
          else
            mesh.quad(a, d, c, b);
        }
      }
    }
  }
  return mesh;
}

Mesh triangulated(const Mesh& mesh) {
  Mesh result;
  result.vertices = mesh.vertices;
  for (size_t p = 0; p < mesh.polygons.size(); ++p) {
    auto polygon = mesh.polygons[p];
    for (size_t c = 2; c < polygon.size(); ++c)
      result.triangle(polygon[0], polygon[c - 1], polygon[c]);
  }
  return result;
}

MeshSequence animate(const Mesh& mesh, uint32_t frames, double unit, const Motion& motion) {
  MeshSequence sequence;
  sequence.polygons = mesh.polygons;
  sequence.vertex_count = static_cast<uint32_t>(mesh.vertices.size());
  sequence.frame_count = frames;
  sequence.rate = {24, 1, false};
  sequence.positions.resize(size_t{3} * sequence.vertex_count * frames);
  double step = unit / 65536;
  // Adding 0 turns -0 into 0: equal positions have equal bits.
  auto snap = [step](double x) { return static_cast<float>(std::round(x / step) * step + 0.0); };
  float* out = sequence.positions.data();
  for (uint32_t f = 0; f < frames; ++f) {
    for (uint32_t v = 0; v < sequence.vertex_count; ++v) {
      Vec3 p = motion(v, mesh.vertices[v], f / 24.0);
      *out++ = snap(p.x);
      *out++ = snap(p.y);
      *out++ = snap(p.z);
    }
  }
  return sequence;
}

}  // namespace anicodec::corpus
