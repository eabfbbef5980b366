// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/poses.h"

#include "codec/sequence/error.h"
#include "corpus/build.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace anicodec::corpus {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kLength = 10, kRadius = 0.4;

using Map = std::function<Vec3(const Vec3&)>;

/// The axis of z wound around the axis of y, by an angle in all, climbing by pitch a turn.
Vec3 wound(const Vec3& p, double angle, double pitch) {
  double climb = pitch * angle / kTurn / kLength;
  double ahead = std::sqrt(1 - climb * climb);
  double radius = ahead * kLength / angle;
  double at = angle * p.z / kLength;
  double c = std::cos(at), s = std::sin(at);
  Vec3 centre{radius * (1 - c), climb * p.z, radius * s};
  Vec3 tangent{ahead * s, climb, ahead * c}, normal{c, 0, -s};
  return centre + p.x * normal + p.y * cross(tangent, normal);
}

Vec3 wrung(const Vec3& p) {
  return rotated(p, {0, 0, 1}, 2 * kTurn * p.z / kLength);
}

/// A cylinder whose cells are `aspect` times as long as wide.
Mesh cylinder(uint32_t vertices, double aspect) {
  // rings * sectors vertices; length / rings = aspect * circumference / sectors.
  double sectors = std::sqrt(vertices * aspect * kTurn * kRadius / kLength);
  auto around = static_cast<uint32_t>(std::lround(sectors));
  auto along = static_cast<uint32_t>(std::lround((vertices - 2) / sectors));
  return tube(along, around, kRadius, kLength);
}

}  // namespace

const std::vector<std::string_view>& pose_names() {
  static const std::vector<std::string_view> names{"bend", "twist", "coil", "needles"};
  return names;
}

MeshSequence make_poses(std::string_view name, uint32_t vertices) {
  if (vertices == 0)
    vertices = 7000;
  if (vertices < 200 || vertices >= (1U << 30))
    throw Error(ErrorKind::kUsage, "poses have at least 200 and less than 2^30 vertices");
  Map pose;
  double aspect = 1;
  if (name == "bend") {
    pose = [](const Vec3& p) { return wound(p, 2 * kTurn, 0); };
  } else if (name == "twist") {
    pose = wrung;
  } else if (name == "coil") {
    pose = [](const Vec3& p) { return wound(p, 2.5 * kTurn, 1.5); };
  } else if (name == "needles") {
    pose = [](const Vec3& p) { return wound(p, 2 * kTurn, 0); };
    aspect = 43;
  } else {
    throw Error(ErrorKind::kUsage, "there are no poses \"" + std::string(name) + "\"");
  }
  Mesh mesh = cylinder(vertices, aspect);
  MeshSequence sequence;
  sequence.name = name;
  sequence.polygons = mesh.polygons;
  sequence.vertex_count = static_cast<uint32_t>(mesh.vertices.size());
  sequence.frame_count = 2;
  auto add = [&](const Vec3& p) {
    for (double x : {p.x, p.y, p.z})
      sequence.positions.push_back(static_cast<float>(x));
  };
  for (const Vec3& p : mesh.vertices)
    add(p);
  for (const Vec3& p : mesh.vertices)
    add(pose(p));
  return sequence;
}

}  // namespace anicodec::corpus
