// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/ray_hit.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
RayHit::RayHit(const Vector3& origin, const Vector3& direction, double farthest, Side side)
    : origin_(origin), direction_(direction), farthest_(farthest), side_(side) {
  size_t z = 0;
  for (size_t i = 1; i < 3; ++i)
    z = std::abs(direction[i]) > std::abs(direction[z]) ? i : z;
  axis_[0] = (z + 1) % 3;
  axis_[1] = (z + 2) % 3;
  axis_[2] = z;
  // Looked at along the ray, triangles keep the way around that they have.
  if (direction[z] < 0)
    std::swap(axis_[0], axis_[1]);
  shear_[0] = direction[axis_[0]] / direction[z];
  shear_[1] = direction[axis_[1]] / direction[z];
  shear_[2] = 1 / direction[z];
}

bool RayHit::meets_box(const float (&min)[3], const float (&max)[3]) const {
  const Vector3 low = vector_at(min), high = vector_at(max);
  double grown = 0;
  for (size_t c = 0; c < 3; ++c)
    grown = std::max(
        {grown, 1e-5 * (high[c] - low[c]), 1e-6 * std::abs(low[c]), 1e-6 * std::abs(high[c])});
  double near = 0, far = farthest_;
  for (size_t c = 0; c < 3; ++c) {
    const double from = low[c] - grown - origin_[c], to = high[c] + grown - origin_[c];
    if (direction_[c] == 0) {
      if (from > 0 || to < 0)
        return false;
      continue;
    }
    near = std::max(near, std::min(from / direction_[c], to / direction_[c]));
    far = std::min(far, std::max(from / direction_[c], to / direction_[c]));
  }
  return near <= far;
}

Vector3 RayHit::sheared(const float* point) const {
  const Vector3 p = vector_at(point) - origin_;
  const double z = p[axis_[2]];
  return {{p[axis_[0]] - shear_[0] * z, p[axis_[1]] - shear_[1] * z, shear_[2] * z}};
}

void RayHit::offer(uint32_t number, const float* a, const float* b, const float* c) {
  const float* points[] = {a, b, c};
  Vector3 p[3];
  for (size_t i = 0; i < 3; ++i)
    p[i] = sheared(points[i]);
  // Twice the areas between the ray and the edges.
  double weights[3], area = 0, sum = 0;
  bool front = true, back = true;
  for (size_t i = 0; i < 3; ++i) {
    const Vector3 &q = p[(i + 1) % 3], &r = p[(i + 2) % 3];
    weights[i] = q[1] * r[0] - q[0] * r[1];
    front &= weights[i] >= 0;
    back &= weights[i] <= 0;
    area += weights[i];
    sum += weights[i] * p[i][2];
  }
  const Side met = front ? Side::kFront : Side::kBack;
  if ((!front && !back) || area == 0 || (side_ != Side::kAny && side_ != met))
    return;
  const double distance = sum / area;
  // The comparison is false for NaN.
  if (!(distance >= 0 && (distance < farthest_ || (triangle_ == kNone && distance == farthest_))))
    return;
  farthest_ = distance;
  triangle_ = number;
  met_ = met;
  for (size_t i = 0; i < 3; ++i)
    weights_[i] = weights[i] / area;
}

}  // namespace anicodec
