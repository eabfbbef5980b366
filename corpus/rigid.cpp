// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/build.h"
#include "corpus/generators.h"

#include <algorithm>
#include <cmath>

namespace anicodec::corpus {
namespace {

/// Sides of a box cut so that `boxes` of them have about n vertices.
uint32_t cuts_of_box(uint32_t n, uint32_t boxes) {
  return std::max<uint32_t>(
      1, static_cast<uint32_t>(std::lround(std::sqrt(std::max(0.0, (n / boxes - 2.0) / 6)))));
}

struct Body {
  Vec3 size, start, velocity, axis;
  double spin;
};

constexpr uint32_t kBodies = 7;

}  // namespace

MeshSequence rigid(ClipSize size) {
  SplitMix64 random(7);
  auto vec = [&](double low, double high) {
    double x = random.uniform(low, high);
    double y = random.uniform(low, high);
    double z = random.uniform(low, high);
    return Vec3{x, y, z};
  };
  std::vector<Body> bodies;
  Mesh mesh;
  Mesh unit = triangulated(quad_box(cuts_of_box(size.vertices, kBodies)));
  for (uint32_t b = 0; b < kBodies; ++b) {
    Vec3 half = vec(0.2, 0.6), start = vec(-2, 2), velocity = vec(-1, 1), axis = vec(0.1, 1);
    bodies.push_back({half, start, velocity, axis, random.uniform(1, 5)});
    mesh.append(unit);
  }
  auto per_body = static_cast<uint32_t>(unit.vertices.size());
  return animate(mesh, size.frames, 8, [&](uint32_t v, const Vec3& rest, double time) {
    const Body& b = bodies[v / per_body];
    Vec3 scaled{b.size.x * rest.x, b.size.y * rest.y, b.size.z * rest.z};
    // It bounces on the floor, so that the path has corners in time.
    double height = std::abs(std::sin(1.5 * time + b.start.z)) * 3;
    Vec3 drift = std::sin(0.6 * time) * b.velocity;
    return rotated(scaled, b.axis, b.spin * time) + drift +
           Vec3{b.start.x, b.start.y + height, b.start.z};
  });
}

MeshSequence far_tumble(ClipSize size) {
  Mesh mesh = triangulated(quad_box(cuts_of_box(size.vertices, 1)));
  // 16 units: 2^-12 is the resolution of float32 at 3000.
  return animate(mesh, size.frames, 16, [](uint32_t, const Vec3& rest, double time) {
    Vec3 body{4 * rest.x, 2 * rest.y, 1.5 * rest.z};
    Vec3 path{3000 + 12 * time, -2000 + 5 * std::sin(time), 1000 - 9 * time};
    return rotated(rotated(body, {1, 2, 0.5}, 2.1 * time), {0, 0.3, 1}, 0.8 * time) + path;
  });
}

namespace {

/// Powers of two keep every mantissa.
MeshSequence scaled_by(MeshSequence sequence, int exponent) {
  for (float& x : sequence.positions)
    x = std::ldexp(x, exponent);
  return sequence;
}

}  // namespace

MeshSequence large(ClipSize size) {
  return scaled_by(limb(size), 40);
}

MeshSequence tiny(ClipSize size) {
  return scaled_by(limb(size), -40);
}

}  // namespace anicodec::corpus
