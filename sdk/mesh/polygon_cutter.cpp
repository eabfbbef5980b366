// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/polygon_cutter.h"

#include <cmath>

namespace anicodec {
namespace {

/// Comparisons that any mesh may take, and more for each corner.
constexpr uint64_t kComparisonsAtLeast = uint64_t{1} << 24, kComparisonsPerCorner = 1024;

/// The part of a polygon's area that rounding makes.
constexpr double kRounding = 1e-9;

}  // namespace

PolygonCutter::PolygonCutter(const float* positions, uint64_t corners)
    : positions_(positions), comparisons_(kComparisonsAtLeast + kComparisonsPerCorner * corners) {}

double PolygonCutter::turn(uint32_t a, uint32_t b, uint32_t c) const {
  return (flat_[b].x - flat_[a].x) * (flat_[c].y - flat_[a].y) -
         (flat_[b].y - flat_[a].y) * (flat_[c].x - flat_[a].x);
}

bool PolygonCutter::is_fan() const {
  const double least = -kRounding * dot(normal_, normal_);
  for (size_t i = 2; i < ring_.size(); ++i) {
    if (dot(cross(ring_[i - 1], ring_[i]), normal_) < least)
      return false;
  }
  return true;
}

void PolygonCutter::flatten() {
  size_t least = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (std::fabs(normal_[i]) < std::fabs(normal_[least]))
      least = i;
  }
  Vector3 axis;
  axis[least] = 1;
  const Vector3 x = cross(axis, normal_), y = (1 / length(normal_)) * cross(normal_, x);
  flat_.clear();
  for (const Vector3& p : ring_)
    flat_.push_back({dot(x, p), dot(y, p)});
  flat_area_ = 0;
  for (uint32_t i = 2; i < flat_.size(); ++i)
    flat_area_ += turn(0, i - 1, i);
}

bool PolygonCutter::is_ear(uint32_t b, Ear kind) {
  const uint32_t a = previous_[b], c = next_[b];
  const double rounding = kRounding * flat_area_, area = turn(a, b, c);
  if (kind == Ear::kFlat)
    return std::fabs(area) <= rounding;
  if (!(area > rounding))
    return false;
  const auto is_at = [&](uint32_t p, uint32_t q) {
    return flat_[p].x == flat_[q].x && flat_[p].y == flat_[q].y;
  };
  for (uint32_t p = next_[c]; p != a && comparisons_ > 0; p = next_[p]) {
    --comparisons_;
    // Copies of the ear's corners stand in polygons with a bridge to a hole.
    if (turn(a, b, p) >= -rounding && turn(b, c, p) >= -rounding && turn(c, a, p) >= -rounding &&
        turn(previous_[p], p, next_[p]) <= rounding && !is_at(p, a) && !is_at(p, b) && !is_at(p, c))
      return false;
  }
  return true;
}

bool PolygonCutter::cut_ears(Vector<uint32_t>* triangles) {
  const auto corners = static_cast<uint32_t>(flat_.size());
  next_.resize(corners);
  previous_.resize(corners);
  for (uint32_t i = 0; i < corners; ++i) {
    next_[i] = (i + 1) % corners;
    previous_[next_[i]] = i;
  }
  // Corners in the middle of straight sides become flat triangles only when no others are left.
  Ear kind = Ear::kWithArea;
  uint32_t at = 0, left = corners, since = 0;
  while (left > 3) {
    if (comparisons_ == 0)
      return false;
    if (!is_ear(at, kind)) {
      at = next_[at];
      if (++since < left)
        continue;
      if (kind == Ear::kFlat)
        return false;
      kind = Ear::kFlat;
      since = 0;
      continue;
    }
    for (const uint32_t corner : {previous_[at], at, next_[at]})
      triangles->push_back(corner);
    next_[previous_[at]] = next_[at];
    previous_[next_[at]] = previous_[at];
    at = next_[next_[at]];  // ears beside one another would be slivers of a fan
    kind = Ear::kWithArea;
    since = 0;
    --left;
  }
  for (const uint32_t corner : {previous_[at], at, next_[at]})
    triangles->push_back(corner);
  return turn(previous_[at], at, next_[at]) >= -kRounding * flat_area_;
}

void PolygonCutter::cut(const uint32_t* vertices, uint32_t corners, Vector<uint32_t>* triangles) {
  if (positions_ && corners > 3) {
    ring_.clear();
    normal_ = {};
    const Vector3 first = vector_at(positions_ + size_t{3} * vertices[0]);
    for (uint32_t i = 0; i < corners; ++i) {
      ring_.push_back(vector_at(positions_ + size_t{3} * vertices[i]) - first);
      if (i > 0)
        normal_ += cross(ring_[i - 1], ring_[i]);
    }
    if (length(normal_) > 0 && !is_fan()) {
      const size_t before = triangles->size();
      flatten();
      if (cut_ears(triangles))
        return;
      triangles->resize(before);
    }
  }
  for (uint32_t i = 2; i < corners; ++i) {
    for (const uint32_t corner : {0U, i - 1, i})
      triangles->push_back(corner);
  }
}

}  // namespace anicodec
