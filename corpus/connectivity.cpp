// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/build.h"
#include "corpus/generators.h"

#include <cmath>
#include <numbers>

namespace anicodec::corpus {
namespace {

/// A gentle bend and twist of anything of about unit size.
Vec3 twisted(const Vec3& rest, double time) {
  Vec3 p = rotated(rest, {0, 0, 1}, 0.8 * std::sin(1.9 * time) * rest.z);
  return {p.x + 0.2 * std::sin(2.3 * time) * p.z * p.z,
          p.y + 0.15 * std::sin(1.1 * time) * p.x * p.x, p.z * (1 + 0.2 * std::sin(1.4 * time))};
}

MeshSequence animate_twisted(const Mesh& mesh, uint32_t frames, double unit = 2) {
  return animate(mesh, frames, unit,
                 [](uint32_t, const Vec3& rest, double time) { return twisted(rest, time); });
}

}  // namespace

MeshSequence one_triangle(ClipSize size) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}};
  mesh.triangle(0, 1, 2);
  return animate_twisted(mesh, size.frames);
}

MeshSequence one_vertex(ClipSize size) {
  Mesh mesh;
  mesh.add({1, 0.5, 0.25});
  return animate_twisted(mesh, size.frames);
}

MeshSequence points(ClipSize size) {
  SplitMix64 random(500);
  Mesh mesh;
  for (uint32_t v = 0; v < size.vertices; ++v) {
    double x = random.uniform(-1, 1);
    double y = random.uniform(-1, 1);
    double z = random.uniform(-1, 1);
    mesh.add({x, y, z});
  }
  return animate(mesh, size.frames, 2, [](uint32_t, const Vec3& rest, double time) {
    // A vortex: the inner turns faster.
    double radius = std::sqrt(rest.x * rest.x + rest.y * rest.y);
    Vec3 p = rotated(rest, {0, 0, 1}, 1.5 * time / (0.3 + radius));
    return Vec3{p.x, p.y, p.z + 0.1 * std::sin(3 * time + 4 * radius)};
  });
}

MeshSequence nonmanifold(ClipSize size) {
  // A book of three pages: the 8 edges of the spine have three faces each. On its last spine vertex
  // stands the tip of a separate fan, a bow-tie.
  const uint32_t along = 9, across = 6;
  Mesh mesh;
  for (uint32_t i = 0; i < along; ++i)
    mesh.add({0, 0, static_cast<double>(i) / (along - 1)});
  for (uint32_t page = 0; page < 3; ++page) {
    double angle = 2 * std::numbers::pi * page / 3;
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (uint32_t j = 1; j < across; ++j) {
      for (uint32_t i = 0; i < along; ++i) {
        double r = 0.12 * j;
        mesh.add({r * std::cos(angle), r * std::sin(angle), static_cast<double>(i) / (along - 1)});
      }
    }
    auto vertex = [&](uint32_t i, uint32_t j) { return j == 0 ? i : first + (j - 1) * along + i; };
    for (uint32_t j = 0; j + 1 < across; ++j) {
      for (uint32_t i = 0; i + 1 < along; ++i) {
        mesh.triangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
        mesh.triangle(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
      }
    }
  }
  const uint32_t spokes = 7;
  auto ring = static_cast<uint32_t>(mesh.vertices.size());
  for (uint32_t s = 0; s < spokes; ++s) {
    double angle = 2 * std::numbers::pi * s / spokes;
    mesh.add({0.3 * std::cos(angle), 0.3 * std::sin(angle), 1.4});
  }
  for (uint32_t s = 0; s < spokes; ++s)
    mesh.triangle(along - 1, ring + s, ring + (s + 1) % spokes);
  return animate_twisted(mesh, size.frames);
}

MeshSequence moebius(ClipSize size) {
  const uint32_t around = 40, across = 5;
  Mesh mesh;
  for (uint32_t i = 0; i < around; ++i) {
    double angle = 2 * std::numbers::pi * i / around;
    for (uint32_t j = 0; j < across; ++j) {
      double w = 0.4 * (2.0 * j / (across - 1) - 1);
      double r = 1 + w * std::cos(angle / 2);
      mesh.add({r * std::cos(angle), r * std::sin(angle), w * std::sin(angle / 2)});
    }
  }
  auto vertex = [&](uint32_t i, uint32_t j) {
    return i < around ? i * across + j : across - 1 - j;  // half a turn: the strip ends upside down
  };
  for (uint32_t i = 0; i < around; ++i) {
    for (uint32_t j = 0; j + 1 < across; ++j) {
      mesh.triangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.triangle(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return animate_twisted(mesh, size.frames);
}

MeshSequence open_pair(ClipSize size) {
  Mesh mesh = grid(14, 9);
  Mesh second = grid(7, 17);
  for (Vec3& p : second.vertices)
    p = {p.x + 1.3, 1.2 * p.y - 0.4, p.x * p.x};
  mesh.append(second);
  return animate_twisted(mesh, size.frames);
}

MeshSequence polygons(ClipSize size) {
  const uint32_t columns = 13, rows = 10;
  Mesh mesh;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      double x = static_cast<double>(i) / (columns - 1), y = static_cast<double>(j) / (rows - 1);
      mesh.add({x, y, 0.3 * std::sin(4 * x) * std::cos(3 * y)});
    }
  }
  for (uint32_t j = 0; j + 1 < rows; ++j) {
    for (uint32_t i = 0; i + 1 < columns; ++i) {
      uint32_t a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      switch ((i + 2 * j) % 3) {
        case 0:
          mesh.quad(a, b, c, d);
          break;
        case 1:
          mesh.triangle(a, b, c);
          mesh.triangle(a, c, d);
          break;
        default: {
          // A vertex inside the cell makes a pentagon and a triangle of it.
          Vec3 middle =
              0.25 * (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c] + mesh.vertices[d]);
          uint32_t m = mesh.add(middle);
          const uint32_t pentagon[] = {a, b, c, m, d};
          mesh.polygons.add(pentagon);
          mesh.triangle(m, c, d);
        }
      }
    }
  }
  return animate_twisted(mesh, size.frames);
}

MeshSequence box_of_quads(ClipSize size) {
  return animate_twisted(quad_box(5), size.frames);
}

MeshSequence painted_box(ClipSize size) {
  constexpr uint32_t kCells = 4, kSides = 6;  // quads along an edge of the box
  MeshSequence clip = animate_twisted(quad_box(kCells), size.frames);
  Attribute uv{AttributeKind::kUv, "atlas", AttributeDomain::kCorner, 2, 1, {}};
  Attribute colour{AttributeKind::kColour, "paint", AttributeDomain::kVertex, 3, 1, {}};
  clip.materials.names = {"wood", "metal"};  // of the second nothing else is known
  MaterialLook wood;
  wood.known = true;
  wood.base_colour = {0.5F, 0.25F, 0.125F, 0.75F};
  wood.roughness = 0.875F;
  wood.emissive = {0, 0.0625F, 0};
  wood.alpha = AlphaMode::kMask;
  wood.alpha_cutoff = 0.25F;
  wood.double_sided = true;
  wood.texture(TextureSlot::kBaseColour) = "textures/wood grain.png";
  wood.texture(TextureSlot::kNormal) = "textures/wood_normal.png";
  clip.materials.looks = {wood, {}};
  clip.parts.names = {"box", "lid"};
  for (uint32_t p = 0; p < clip.polygons.size(); ++p) {
    const uint32_t side = p / (kCells * kCells), cell = p % (kCells * kCells);
    // Each side has a square of the atlas, three by two, and edges of the box are hard.
    const bool is_far = side % 2 == 1;
    constexpr uint32_t kAlong[] = {0, 1, 1, 0}, kAcross[] = {0, 0, 1, 1};
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t u = cell / kCells + (is_far ? kAlong : kAcross)[k];
      const uint32_t v = cell % kCells + (is_far ? kAcross : kAlong)[k];
      uv.values.push_back((static_cast<float>(side % 3) + static_cast<float>(u) / kCells) / 4);
      uv.values.push_back((static_cast<float>(side / 3) + static_cast<float>(v) / kCells) / 2);
      clip.shared_normals.push_back(clip.polygons[p][k] * kSides + side);
    }
    clip.materials.of_polygon.push_back(cell == 0 ? kNoLabel : side / 4);
    clip.parts.of_polygon.push_back(side == kSides - 1 ? 1 : 0);
  }
  for (uint32_t v = 0; v < clip.vertex_count; ++v) {
    for (uint32_t i = 0; i < 3; ++i)
      colour.values.push_back(static_cast<float>((v * 5 + i * 80) % 256) / 255);
  }
  clip.attributes = {uv, colour};
  return clip;
}

MeshSequence leftovers(ClipSize size) {
  const uint32_t side = 12;
  Mesh sheet = grid(side, side);
  Mesh mesh;
  // Unused vertices before, between (where the first corner of the sheet is left out of all faces)
  // and after the used ones.
  mesh.add({-1, -1, -1});
  mesh.append(sheet);
  mesh.add({2, 2, 0.5});
  mesh.add({2, 0, 0.5});
  Polygons faces;
  for (size_t t = 2; t < mesh.polygons.size(); ++t)
    faces.add(mesh.polygons[t]);
  mesh.polygons = faces;
  // Duplicates: the same corners, turned round, and the other way about.
  auto first = faces[0];
  uint32_t a = first[0], b = first[1], c = first[2];
  mesh.triangle(a, b, c);
  mesh.triangle(b, c, a);
  mesh.triangle(c, b, a);
  // Degenerate: corners repeated, also in position only.
  mesh.triangle(a, a, b);
  mesh.triangle(b, c, b);
  mesh.triangle(a, a, a);
  Vec3 at = mesh.vertices[a];
  uint32_t twin = mesh.add(at);
  mesh.triangle(a, twin, b);
  return animate(mesh, size.frames, 2, [](uint32_t v, const Vec3& rest, double time) {
    return v == 1 ? Vec3{5, 5, 5} : twisted(rest, time);
  });
}

}  // namespace anicodec::corpus
