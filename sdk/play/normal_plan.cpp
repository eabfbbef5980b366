// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/normal_plan.h"

#include "sdk/base/disjoint_sets.h"
#include "sdk/mesh/half_edges.h"
#include "sdk/play/play.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

namespace anicodec {
namespace {

/// Normals that are stored at a time.
constexpr uint32_t kRange = 16 * kBlock;

struct Direction {
  float v[3] = {0, 0, 0};

  void add_cross(const float* centre, const float* next, const float* previous) {
    const float a[3] = {next[0] - centre[0], next[1] - centre[1], next[2] - centre[2]};
    const float b[3] = {previous[0] - centre[0], previous[1] - centre[1], previous[2] - centre[2]};
    v[0] += a[1] * b[2] - a[2] * b[1];
    v[1] += a[2] * b[0] - a[0] * b[2];
    v[2] += a[0] * b[1] - a[1] * b[0];
  }

  /// Has length one; squares of any coordinates fit in a double.
  void normalise() {
    const double x = double{v[0]}, y = double{v[1]}, z = double{v[2]};
    const double length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0) || !std::isfinite(length)) {
      *this = {{0, 0, 1}};
      return;
    }
    v[0] = static_cast<float>(x / length);
    v[1] = static_cast<float>(y / length);
    v[2] = static_cast<float>(z / length);
  }

  double dot(const Direction& other) const {
    return double{v[0]} * double{other.v[0]} + double{v[1]} * double{other.v[1]} +
           double{v[2]} * double{other.v[2]};
  }

  bool is_zero() const { return v[0] == 0 && v[1] == 0 && v[2] == 0; }
};

/// Polygons by their corners.
class Corners {
 public:
  explicit Corners(const Topology& topology)
      : t_(topology), polygon_(topology.polygon_corners.size()) {
    for (uint32_t p = 0; p + 1 < t_.polygon_offsets.size(); ++p) {
      for (uint32_t c = t_.polygon_offsets[p]; c < t_.polygon_offsets[p + 1]; ++c)
        polygon_[c] = p;
    }
  }

  uint32_t count() const { return static_cast<uint32_t>(polygon_.size()); }

  uint32_t polygon(uint32_t c) const { return polygon_[c]; }

  uint32_t vertex(uint32_t c) const { return t_.polygon_corners[c]; }

  uint32_t coded(uint32_t c) const { return t_.vertex_coded[vertex(c)]; }

  uint32_t next(uint32_t c) const {
    return c + 1 == t_.polygon_offsets[polygon_[c] + 1] ? t_.polygon_offsets[polygon_[c]] : c + 1;
  }

  uint32_t previous(uint32_t c) const {
    return (c == t_.polygon_offsets[polygon_[c]] ? t_.polygon_offsets[polygon_[c] + 1] : c) - 1;
  }

  /// Whether the polygon has an area to speak of.
  bool is_face(uint32_t c) const {
    return t_.polygon_offsets[polygon_[c] + 1] - t_.polygon_offsets[polygon_[c]] >= 3;
  }

 private:
  const Topology& t_;
  Vector<uint32_t> polygon_;
};

/// Normals of the polygons, as fans; zero where areas cancel.
Vector<Direction> polygon_normals(const Topology& t, const float* pose) {
  Vector<Direction> normals(t.polygon_offsets.size() - 1);
  for (size_t p = 0; p < normals.size(); ++p) {
    const uint32_t* corner = t.polygon_corners.data() + t.polygon_offsets[p];
    const uint32_t count = t.polygon_offsets[p + 1] - t.polygon_offsets[p];
    for (uint32_t i = 2; i < count; ++i)
      normals[p].add_cross(pose + size_t{3} * corner[0], pose + size_t{3} * corner[i - 1],
                           pose + size_t{3} * corner[i]);
    if (!normals[p].is_zero())
      normals[p].normalise();
  }
  return normals;
}

/// Joins the corners at both ends of every edge that is no crease. Of the polygons at an edge, each
/// is compared with the next one.
void join_across_edges(const Topology& topology, const Corners& corners, const float* pose,
                       double crease_cosine, DisjointSets* sets) {
  const Vector<Direction> normals = polygon_normals(topology, pose);
  const auto join_unless_crease = [&](uint32_t a, uint32_t b) {
    const Direction &x = normals[corners.polygon(a)], &y = normals[corners.polygon(b)];
    if (!x.is_zero() && !y.is_zero() && x.dot(y) < crease_cosine)
      return;
    uint32_t first = b, second = corners.next(b);
    if (corners.coded(first) != corners.coded(a))
      std::swap(first, second);
    sets->join(a, first);
    sets->join(corners.next(a), second);
  };
  const HalfEdges half_edges(
      topology.coded_vertices, corners.count(), [&](uint32_t c) { return corners.coded(c); },
      [&](uint32_t c) { return corners.next(c); });
  half_edges.for_each_edge(
      [&](uint32_t low, uint32_t high, const HalfEdges::Item* first, const HalfEdges::Item* last) {
        for (const HalfEdges::Item* item = first; low != high && item + 1 != last; ++item)
          join_unless_crease(item[0].corner, item[1].corner);
      });
}

/// Joins the corners that have the same key, below `keys`.
template <class Key>
void join_equal(const Corners& corners, uint32_t keys, Key key, DisjointSets* sets) {
  constexpr uint32_t kNone = UINT32_MAX;
  Vector<uint32_t> first(keys, kNone);
  for (uint32_t c = 0; c < corners.count(); ++c) {
    uint32_t& of_key = first[key(c)];
    if (of_key == kNone)
      of_key = c;
    else
      sets->join(of_key, c);
  }
}

/// The plan of corners whose sets are given.
NormalPlan plan_of(const Topology& topology, const Corners& corners, bool per_corner,
                   DisjointSets& sets) {
  const auto vertices = static_cast<uint32_t>(topology.vertex_coded.size());
  if (!per_corner)
    join_equal(
        corners, vertices, [&](uint32_t c) { return corners.vertex(c); }, &sets);

  // Groups are numbered as their first corners come; elements without a corner get one more.
  NormalPlan plan;
  Vector<uint32_t> group_of(corners.count());
  uint32_t groups = 0;
  for (uint32_t c = 0; c < corners.count(); ++c)
    group_of[c] = sets.find(c) == c ? groups++ : group_of[sets.find(c)];
  plan.begin.assign(size_t{groups} + 2, 0);
  plan.centre.assign(size_t{groups} + 1, 0);
  for (uint32_t c = corners.count(); c-- > 0;) {
    plan.centre[group_of[c]] = corners.vertex(c);
    plan.begin[group_of[c] + 1] += corners.is_face(c);
  }
  for (size_t g = 0; g + 1 < plan.begin.size(); ++g)
    plan.begin[g + 1] += plan.begin[g];
  plan.corners.resize(plan.begin.back());
  Vector<uint32_t> at(plan.begin.begin(), plan.begin.end() - 1);
  for (uint32_t c = 0; c < corners.count(); ++c) {
    if (corners.is_face(c))
      plan.corners[at[group_of[c]]++] = {corners.vertex(corners.next(c)),
                                         corners.vertex(corners.previous(c))};
  }
  if (per_corner) {
    plan.group = std::move(group_of);
  } else {
    plan.group.assign(vertices, groups);
    for (uint32_t c = 0; c < corners.count(); ++c)
      plan.group[corners.vertex(c)] = group_of[c];
  }
  return plan;
}

}  // namespace

NormalPlan plan_normals(const Topology& topology, const float* pose, double crease_cosine,
                        bool per_corner) {
  const Corners corners(topology);
  DisjointSets sets(corners.count());
  if (crease_cosine <= -1)
    join_equal(
        corners, topology.coded_vertices, [&](uint32_t c) { return corners.coded(c); }, &sets);
  else
    join_across_edges(topology, corners, pose, crease_cosine, &sets);
  return plan_of(topology, corners, per_corner, sets);
}

NormalPlan plan_normals(const Topology& topology, const Vector<uint32_t>& shared, bool per_corner) {
  const Corners corners(topology);
  DisjointSets sets(corners.count());
  join_equal(
      corners, corners.count(), [&](uint32_t c) { return shared[c]; }, &sets);
  return plan_of(topology, corners, per_corner, sets);
}

void compute_normals(const NormalPlan& plan, const float* pose, size_t stride, uint32_t first,
                     uint32_t count, const VertexOutput& output) {
  auto point = [&](uint32_t v, float(&to)[3]) {
    std::memcpy(to, reinterpret_cast<const unsigned char*>(pose) + stride * v, sizeof to);
  };
  VertexOutput rest = output;
  for (uint32_t end = first + count; first < end;) {
    const uint32_t n = std::min(end - first, kRange);
    float blocks[3 * kRange] = {};
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t group = plan.group[first + i];
      float centre[3], next[3], previous[3];
      point(plan.centre[group], centre);
      Direction normal;
      for (uint32_t c = plan.begin[group]; c < plan.begin[group + 1]; ++c) {
        point(plan.corners[c].next, next);
        point(plan.corners[c].previous, previous);
        normal.add_cross(centre, next, previous);
      }
      normal.normalise();
      for (uint32_t c = 0; c < 3; ++c)
        blocks[(i / kBlock * 3 + c) * kBlock + i % kBlock] = normal.v[c];
    }
    store_points(blocks, 0, n, rest);
    rest.data = static_cast<unsigned char*>(rest.data) + rest.stride * n;
    first += n;
  }
}

}  // namespace anicodec
