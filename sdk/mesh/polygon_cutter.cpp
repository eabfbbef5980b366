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
  return cross(ring_[b] - ring_[a], ring_[c] - ring_[a])[2];
}

bool PolygonCutter::is_fan(const Vector3& normal) const {
  const double least = -kRounding * dot(normal, normal);
  for (size_t i = 2; i < ring_.size(); ++i) {
    if (dot(cross(ring_[i - 1], ring_[i]), normal) < least)
      return false;
  }
  return true;
}

void PolygonCutter::flatten(const Vector3& normal) {
  size_t least = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (std::fabs(normal[i]) < std::fabs(normal[least]))
      least = i;
  }
  Vector3 axis;
  axis[least] = 1;
  const Vector3 x = cross(axis, normal), y = (1 / length(normal)) * cross(normal, x);
  double area = 0;
  for (uint32_t i = 0; i < ring_.size(); ++i) {
    ring_[i] = {{dot(x, ring_[i]), dot(y, ring_[i]), 0}};
    if (i > 1)
      area += turn(0, i - 1, i);
  }
  rounding_ = kRounding * area;
}

bool PolygonCutter::is_ear(uint32_t b, Ear kind) {
  const uint32_t a = previous(b), c = next(b);
  const double area = turn(a, b, c);
  if (kind == Ear::kFlat)
    return std::fabs(area) <= rounding_;
  if (!(area > rounding_))
    return false;
  const auto is_at = [&](uint32_t p, uint32_t q) {
    return ring_[p][0] == ring_[q][0] && ring_[p][1] == ring_[q][1];
  };
  for (uint32_t p = next(c); p != a && comparisons_ > 0; p = next(p)) {
    --comparisons_;
    // Copies of the ear's corners stand in polygons with a bridge to a hole.
    if (turn(a, b, p) >= -rounding_ && turn(b, c, p) >= -rounding_ && turn(c, a, p) >= -rounding_ &&
        turn(previous(p), p, next(p)) <= rounding_ && !is_at(p, a) && !is_at(p, b) && !is_at(p, c))
      return false;
  }
  return true;
}

bool PolygonCutter::cut_ears(Vector<uint32_t>* triangles) {
  const auto corners = static_cast<uint32_t>(ring_.size());
  links_.resize(size_t{2} * corners);
  for (uint32_t i = 0; i < corners; ++i) {
    next(i) = i + 1 < corners ? i + 1 : 0;
    previous(next(i)) = i;
  }
  // Corners in the middle of straight sides become flat triangles only when no others are left.
  Ear kind = Ear::kWithArea;
  uint32_t at = 0, left = corners, since = 0;
  while (left > 3) {
    if (comparisons_ == 0)
      return false;
    if (!is_ear(at, kind)) {
      at = next(at);
      if (++since < left)
        continue;
      if (kind == Ear::kFlat)
        return false;
      kind = Ear::kFlat;
      since = 0;
      continue;
    }
    for (const uint32_t corner : {previous(at), at, next(at)})
      triangles->push_back(corner);
    next(previous(at)) = next(at);
    previous(next(at)) = previous(at);
    at = next(next(at));  // ears beside one another would be slivers of a fan
    kind = Ear::kWithArea;
    since = 0;
    --left;
  }
  for (const uint32_t corner : {previous(at), at, next(at)})
    triangles->push_back(corner);
  return turn(previous(at), at, next(at)) >= -rounding_;
}

void PolygonCutter::cut(const uint32_t* vertices, uint32_t corners, Vector<uint32_t>* triangles) {
  if (positions_ && corners > 3) {
    ring_.resize(corners);
    Vector3 normal;  // twice the area
    const Vector3 first = vector_at(positions_ + size_t{3} * vertices[0]);
    for (uint32_t i = 0; i < corners; ++i) {
      ring_[i] = vector_at(positions_ + size_t{3} * vertices[i]) - first;
      if (i > 0)
        normal += cross(ring_[i - 1], ring_[i]);
    }
    if (length(normal) > 0 && !is_fan(normal)) {
      const size_t before = triangles->size();
      flatten(normal);
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
