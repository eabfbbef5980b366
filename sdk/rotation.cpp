// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/rotation.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

double dot(const Quaternion& a, const Quaternion& b) {
  return a.q[0] * b.q[0] + a.q[1] * b.q[1] + a.q[2] * b.q[2] + a.q[3] * b.q[3];
}

Quaternion sum(double x, const Quaternion& a, double y, const Quaternion& b) {
  Quaternion result;
  for (int i = 0; i < 4; ++i)
    result.q[i] = x * a.q[i] + y * b.q[i];
  return result;
}

/// Length one; `otherwise` when it has none.
Quaternion normalised(const Quaternion& a, const Quaternion& otherwise) {
  const double length = std::sqrt(dot(a, a));
  return length > 1e-6 ? sum(1 / length, a, 0, a) : otherwise;
}

}  // namespace

Quaternion rotation_of(const Affine& motion) {
  const float* m = motion.m;
  const double d[3] = {double{m[0]}, double{m[5]}, double{m[10]}};
  const double trace = d[0] + d[1] + d[2];
  Quaternion r;
  if (trace >= std::max({d[0], d[1], d[2]})) {
    r.q[0] = 1 + trace;
    r.q[1] = double{m[9]} - double{m[6]};
    r.q[2] = double{m[2]} - double{m[8]};
    r.q[3] = double{m[4]} - double{m[1]};
  } else {
    const int i = d[0] >= d[1] && d[0] >= d[2] ? 0 : d[1] >= d[2] ? 1 : 2;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    auto at = [&](int row, int column) { return double{m[4 * row + column]}; };
    r.q[0] = at(k, j) - at(j, k);
    r.q[1 + i] = 1 + d[i] - d[j] - d[k];
    r.q[1 + j] = at(j, i) + at(i, j);
    r.q[1 + k] = at(k, i) + at(i, k);
  }
  return normalised(r, {});
}

Affine motion_of(const Quaternion& rotation, const double (&translation)[3]) {
  const double w = rotation.q[0], x = rotation.q[1], y = rotation.q[2], z = rotation.q[3];
  const double m[12] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                        translation[0],          2 * (x * y + w * z),     1 - 2 * (x * x + z * z),
                        2 * (y * z - w * x),     translation[1],          2 * (x * z - w * y),
                        2 * (y * z + w * x),     1 - 2 * (x * x + y * y), translation[2]};
  Affine result;
  std::transform(m, m + 12, result.m, [](double v) { return static_cast<float>(v); });
  return result;
}

Quaternion mean_rotation(const Quaternion* rotations, const double* weights, int count) {
  const Quaternion& a = rotations[0];
  if (count == 2) {
    const double cosine = dot(a, rotations[1]);
    const double sign = cosine < 0 ? -1 : 1;
    const double angle = std::acos(std::min(std::fabs(cosine), 1.0));
    if (angle < 1e-6)
      return normalised(sum(weights[0], a, sign * weights[1], rotations[1]), a);
    return normalised(sum(std::sin(weights[0] * angle) / std::sin(angle), a,
                          sign * std::sin(weights[1] * angle) / std::sin(angle), rotations[1]),
                      a);
  }
  Quaternion total = sum(weights[0], a, 0, a);
  for (int i = 1; i < count; ++i)
    total = sum(1, total, dot(a, rotations[i]) < 0 ? -weights[i] : weights[i], rotations[i]);
  return normalised(total, a);
}

}  // namespace anicodec
