// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/partner_surface.h"

#include <cmath>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Vector3d;

/// Forward, sideways and the normal at an edge, seen from the vertex o.
bool frame(const PartnerSurface& s, uint32_t a, uint32_t b, uint32_t o, Vector3d* f) {
  const Vector3d side = s[b] - s[a];
  const Vector3d normal = side.cross(s[o] - s[a]);
  const double size = normal.norm(), wide = side.norm();
  if (!(size > 1e-9 * wide * wide))
    return false;
  f[2] = normal / size;
  f[1] = side / wide;
  f[0] = f[1].cross(f[2]);
  return true;
}

}  // namespace

bool turned_offset(const PartnerSurface& s, const Triple& gate, uint32_t v, const Triple& images,
                   bool mirrored, Vector3d* offset) {
  const auto [a, b, o] = gate;
  Vector3d here[3], there[3];
  if (!frame(s, a, b, o, here) || !frame(s, images[0], images[1], images[2], there))
    return false;
  if (mirrored)
    there[2] = -there[2];
  const Vector3d e = s[v] - (s[a] + s[b] - s[o]);
  *offset = e.dot(here[0]) * there[0] + e.dot(here[1]) * there[1] + e.dot(here[2]) * there[2];
  return true;
}

double partner_gain(double alone, double with_partner, double edge) {
  constexpr double kFloor = 0.02;  // of an edge: errors below do not count
  const double floor = kFloor * edge + 1e-300;
  return std::log2((alone + floor) / (with_partner + floor));
}

}  // namespace anicodec
