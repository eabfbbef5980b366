// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/triangle_axes.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

/// Gives a vector the length 1; false if it has none. Scaled first, or the squares of a normal of tiny edges would be 0.
bool normalise(Vector3* v) {
  double largest = 0;
  for (double x : v->x)
    largest = std::max(largest, std::abs(x));
  if (!(largest > 0))
    return false;
  *v = 1 / largest * *v;
  *v = 1 / length(*v) * *v;
  return true;
}

}  // namespace

TriangleAxes::TriangleAxes(const Vector3 (&corners)[3]) {
  Vector3 side = corners[2] - corners[0];
  tangent = corners[1] - corners[0];
  const double size = length(side) + length(tangent);
  normal = cross(tangent, side);
  if (!normalise(&tangent)) {
    tangent = side;
    if (!normalise(&tangent))
      tangent[0] = 1;
  }
  // Rounding alone is no normal.
  if (!(length(normal) > 1e-10 * size * size)) {
    size_t least = 0;
    for (size_t c = 1; c < 3; ++c)
      least = std::abs(tangent[c]) < std::abs(tangent[least]) ? c : least;
    side = {};
    side[least] = 1;
    normal = cross(tangent, side);
  }
  normalise(&normal);
}

}  // namespace anicodec
