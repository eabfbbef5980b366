// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/build.h"
#include "corpus/generators.h"
#include "corpus/sliding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace anicodec::corpus {
namespace {

constexpr double kPi = std::numbers::pi;

/// A tube of about n vertices whose cells are about square.
Mesh tube_of(uint32_t n, double radius, double length) {
  double ratio = length / (2 * kPi * radius);
  auto sectors = std::max<uint32_t>(8, static_cast<uint32_t>(std::lround(std::sqrt(n / ratio))));
  auto rings = std::max<uint32_t>(4, static_cast<uint32_t>(std::lround((n - 2.0) / sectors)));
  return tube(rings, sectors, radius, length);
}

uint32_t side_of_square(uint32_t n) {
  return std::max<uint32_t>(4, static_cast<uint32_t>(std::lround(std::sqrt(n))));
}

/// Linear blend skinning of a tube of length 3 by three bones along z with joints at 1 and 2: the
/// root sways, the second bends, the third bends across and twists.
Vec3 skinned(const Vec3& rest, double time) {
  double sway = 0.25 * std::sin(0.9 * time);
  double bend = 1.1 * std::sin(1.7 * time + 0.4);
  double across = 0.9 * std::sin(2.3 * time);
  double twist = 1.2 * std::sin(1.3 * time + 1.0);
  const Vec3 joint1{0, 0, 1}, joint2{0, 0, 2};
  auto root = [&](const Vec3& p) { return rotated(p, {0, 1, 0}, sway); };
  auto second = [&](const Vec3& p) { return root(joint1 + rotated(p - joint1, {1, 0, 0}, bend)); };
  auto third = [&](const Vec3& p) {
    return second(joint2 + rotated(rotated(p - joint2, {0, 0, 1}, twist), {0, 1, 0}, across));
  };
  double w1 = smooth_step((rest.z - 0.65) / 0.7);
  double w2 = smooth_step((rest.z - 1.65) / 0.7);
  return (1 - w1) * root(rest) + (w1 * (1 - w2)) * second(rest) + (w1 * w2) * third(rest);
}

/// A sheet pinned at x = 0 with waves that travel away from the pole and across.
Vec3 waving(const Vec3& rest, double time) {
  double x = 1.5 * rest.x, y = rest.y - 0.5;
  auto wave = [&](double kx, double ky, double speed, double phase) {
    return std::sin(2 * kPi * (kx * x + ky * y - speed * time) + phase);
  };
  double grow = rest.x * (2 - rest.x);
  double depth = 0.16 * wave(0.9, 0.2, 0.7, 0) + 0.06 * wave(2.1, -0.7, 1.3, 1.1) +
                 0.03 * wave(3.7, 1.6, 1.9, 2.3);
  double lift = 0.05 * wave(0.6, 0.5, 0.5, 0.7);
  double pull = 0.06 * (wave(0.4, 0, 0.7, 0.3) - 1);
  return {x + grow * pull, y + grow * lift - 0.08 * grow * x, grow * depth};
}

struct Blend {
  double x, y, radius;  ///< where it acts
  Vec3 offset;
  double period, phase;  ///< seconds
};

/// Half a mask: brows, lids, cheeks, mouth corners, lip, jaw.
constexpr Blend kBlends[] = {
    {-0.35, 0.55, 0.30, {0.00, 0.12, 0.03}, 2.1, 0.0},
    {0.35, 0.55, 0.30, {0.00, 0.12, 0.03}, 2.1, 0.2},
    {-0.35, 0.30, 0.18, {0.00, -0.07, 0.04}, 1.3, 0.5},
    {0.35, 0.30, 0.18, {0.00, -0.07, 0.04}, 1.3, 0.5},
    {-0.50, -0.10, 0.32, {-0.04, 0.06, 0.08}, 2.9, 1.1},
    {0.50, -0.10, 0.32, {0.04, 0.06, 0.08}, 2.9, 1.1},
    {-0.28, -0.42, 0.22, {-0.08, 0.05, -0.02}, 1.7, 0.9},
    {0.28, -0.42, 0.22, {0.08, 0.04, -0.02}, 1.9, 0.3},
    {0.00, -0.38, 0.16, {0.00, 0.03, 0.07}, 1.1, 0.0},
    {0.00, -0.62, 0.42, {0.00, -0.20, -0.04}, 1.5, 0.6},
};

Vec3 expression(const Vec3& rest, double time) {
  Vec3 p = rest;
  for (const Blend& b : kBlends) {
    double dx = rest.x - b.x, dy = rest.y - b.y;
    double inside = 1 - (dx * dx + dy * dy) / (b.radius * b.radius);
    if (inside <= 0)
      continue;
    double pulse = std::max(0.0, std::sin(2 * kPi * (time / b.period + b.phase)));
    p = p + (inside * inside * pulse * pulse) * b.offset;
  }
  return p;
}

/// A straight rod around z wound up: constant curvature and torsion, so the frame at arc length s
/// is turned by s times the Darboux vector and the axis is a helix.
Vec3 wound(const Vec3& rest, double amount) {
  Vec3 darboux = amount * Vec3{2.2, 0, 1.1};
  double rate = std::sqrt(dot(darboux, darboux));
  double s = rest.z;
  Vec3 around{rest.x, rest.y, 0};
  if (rate * s < 1e-6)
    return rest;
  Vec3 u = (1 / rate) * darboux;
  const Vec3 z{0, 0, 1};
  double angle = rate * s;
  Vec3 centre = s * z + ((1 - std::cos(angle)) / rate) * cross(u, z) +
                (s - std::sin(angle) / rate) * cross(u, cross(u, z));
  return centre + rotated(around, u, angle);
}

Mesh sheet(uint32_t n) {
  uint32_t side = side_of_square(n);
  return grid(side, side);
}

}  // namespace

MeshSequence limb(ClipSize size) {
  return animate(tube_of(size.vertices, 0.3, 3), size.frames, 4,
                 [](uint32_t, const Vec3& rest, double time) { return skinned(rest, time); });
}

MeshSequence cloth(ClipSize size) {
  return animate(sheet(size.vertices), size.frames, 2,
                 [](uint32_t, const Vec3& rest, double time) { return waving(rest, time); });
}

MeshSequence face(ClipSize size) {
  Mesh mesh = sheet(size.vertices);
  for (Vec3& p : mesh.vertices) {
    double x = 2 * p.x - 1, y = 2 * p.y - 1;
    // A square mapped to a disc keeps the border smooth; the disc is the front of an ellipsoid.
    double u = x * std::sqrt(1 - y * y / 2), v = y * std::sqrt(1 - x * x / 2);
    double nose = std::max(0.0, 1 - (u * u + (v + 0.05) * (v + 0.05) / 3) / 0.04);
    p = {0.8 * u, 1.1 * v,
         0.7 * std::sqrt(std::max(0.0, 1.05 - u * u - v * v)) + 0.18 * nose * nose};
  }
  return animate(mesh, size.frames, 1,
                 [](uint32_t, const Vec3& rest, double time) { return expression(rest, time); });
}

MeshSequence helix(ClipSize size) {
  double length = 12;
  double end = std::max(1.0, size.frames - 1.0) / 24;
  return animate(
      tube_of(size.vertices, 0.25, length), size.frames, 16,
      [end](uint32_t, const Vec3& rest, double time) { return wound(rest, time / end); });
}

MeshSequence noisy(ClipSize size) {
  SplitMix64 random(20);
  return animate(sheet(size.vertices), size.frames, 2,
                 [&](uint32_t, const Vec3& rest, double time) {
                   double x = random.uniform(-1, 1);
                   double y = random.uniform(-1, 1);
                   double z = random.uniform(-1, 1);
                   return waving(rest, time) + 0.002 * Vec3{x, y, z};
                 });
}

MeshSequence limb_soup(ClipSize size) {
  Mesh welded = tube_of(size.vertices / 6, 0.3, 3);
  Mesh soup;
  for (size_t t = 0; t < welded.polygons.size(); ++t) {
    auto corner = [&](size_t c) { return soup.add(welded.vertices[welded.polygons[t][c]]); };
    uint32_t a = corner(0), b = corner(1), c = corner(2);
    soup.triangle(a, b, c);
  }
  return animate(soup, size.frames, 4,
                 [](uint32_t, const Vec3& rest, double time) { return skinned(rest, time); });
}

MeshSequence sliding(ClipSize size) {
  return slide_vertices(limb(size), 0.3, 4.0 / 65536, 21);
}

}  // namespace anicodec::corpus
