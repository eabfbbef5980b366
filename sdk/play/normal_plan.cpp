// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/normal_plan.h"

#include "format/sort.h"
#include "sdk/base/disjoint_sets.h"
#include "sdk/base/lanes.h"
#include "sdk/mesh/half_edges.h"
#include "sdk/play/play.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

namespace anicodec {
namespace {

constexpr uint32_t kRange = NormalPlan::kRange;
static_assert(kRange % kBlock == 0);

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

/// Joins the corners at both ends of every edge that is no crease. Each polygon at an edge is
/// compared with the next one.
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
    plan.group = group_of;
  } else {
    plan.group.assign(vertices, groups);
    for (uint32_t c = 0; c < corners.count(); ++c)
      plan.group[corners.vertex(c)] = group_of[c];
  }
  list_areas(&plan);
  return plan;
}

/// Three numbers in lanes 1 to 3; lane 0 is anything.
using Float4 = LaneTypes<4>::Float;

/// A vertex of a pose. Reads the four bytes before it, those of the vertex before, and none behind.
ANICODEC_INLINE Float4 load_point(const unsigned char* pose, size_t stride, uint32_t v) {
  if (v == 0) {
    float p[3];
    std::memcpy(p, pose, sizeof p);
    return Float4{0.0F, p[0], p[1], p[2]};
  }
  LaneTypes<4>::Unaligned p;
  std::memcpy(&p, pose + stride * v - sizeof(float), sizeof p);
  return p;
}

/// Numbers 1, 2, 0.
ANICODEC_INLINE Float4 rotated(Float4 x) {
  return ANICODEC_SHUFFLE(x, x, 0, 2, 3, 1);
}

/// Sums of the areas of a range: of its groups, and one that is nobody's.
void sum_areas(const NormalPlan& plan, uint32_t range, const unsigned char* pose, size_t stride,
               Float4 (&sums)[kRange + 1]) {
  for (uint32_t i = plan.range_begin[range]; i < plan.range_begin[range + 1]; ++i) {
    const NormalPlan::Area& area = plan.areas[i];
    const Float4 corner = load_point(pose, stride, area.vertex[0]);
    const Float4 a = load_point(pose, stride, area.vertex[1]) - corner,
                 b = load_point(pose, stride, area.vertex[2]) - corner;
    const Float4 cross = rotated(a * rotated(b) - rotated(a) * b);
    for (const uint16_t group : area.to)
      sums[group] += cross;
  }
}

/// Vectors of length one from blocks of vectors, (0, 0, 1) from what has no direction.
void normalise(float* blocks, uint32_t count) {
  using Lanes = LaneTypes<4>;
  for (uint32_t b = 0; b < block_count(count); ++b) {
    for (uint32_t i = 0; i < kBlock; i += 4) {
      float* at = blocks + size_t{b} * 3 * kBlock + i;
      Lanes::Float v[3];
      for (uint32_t c = 0; c < 3; ++c)
        std::memcpy(&v[c], at + size_t{c} * kBlock, sizeof v[c]);
      // Scaled by a power of two: squares neither overflow nor vanish.
      Lanes::Float most{};
      for (const Lanes::Float& x : v) {
        const Lanes::Float size = x < 0.0F ? -x : x;
        most = size > most ? size : most;
      }
      constexpr uint32_t kExponent = 0x7F800000, kOne = 0x3F800000;
      const Lanes::Bits exponent = reinterpret_cast<Lanes::Bits>(most) & kExponent;
      const auto scale = reinterpret_cast<Lanes::Float>(2 * kOne - exponent);
      Lanes::Float squares{};
      for (Lanes::Float& x : v) {
        x *= scale;
        squares += x * x;
      }
      const Lanes::Float inverse = 1.0F / square_root(squares);
      // Neither 0 nor too small for the scale, and finite.
      const Lanes::Int sound = (squares >= 0.5F) & (squares < 16.0F);
      for (uint32_t c = 0; c < 3; ++c) {
        const Lanes::Float up = Lanes::Float{} + (c == 2 ? 1.0F : 0.0F);
        const Lanes::Float unit = sound ? v[c] * inverse : up;
        std::memcpy(at + size_t{c} * kBlock, &unit, sizeof unit);
      }
    }
  }
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

void list_areas(NormalPlan* plan) {
  /// The share of a corner of a group of the range: from the smallest of its vertices on, so that
  /// the corners of a triangle add the same.
  struct Added {
    std::array<uint32_t, 3> vertex;
    uint16_t to;

    bool operator<(const Added& other) const {
      return std::tie(vertex, to) < std::tie(other.vertex, other.to);
    }
  };

  constexpr uint32_t kNone = UINT32_MAX;
  Vector<uint32_t> numbers(plan->centre.size(), kNone), groups;
  Vector<Added> added;
  plan->local.resize(plan->size());
  plan->areas.clear();
  plan->range_begin.assign(1, 0);
  for (uint32_t first = 0; first < plan->size(); first += kRange) {
    groups.clear();
    added.clear();
    for (uint32_t i = first; i < std::min(first + kRange, plan->size()); ++i) {
      const uint32_t g = plan->group[i];
      if (numbers[g] == kNone) {
        numbers[g] = static_cast<uint32_t>(groups.size());
        groups.push_back(g);
        for (uint32_t c = plan->begin[g]; c < plan->begin[g + 1]; ++c) {
          Added a{{plan->centre[g], plan->corners[c].next, plan->corners[c].previous},
                  static_cast<uint16_t>(numbers[g])};
          std::rotate(a.vertex.begin(), std::min_element(a.vertex.begin(), a.vertex.end()),
                      a.vertex.end());
          added.push_back(a);
        }
      }
      plan->local[i] = static_cast<uint16_t>(numbers[g]);
    }
    for (const uint32_t g : groups)
      numbers[g] = kNone;
    // In the order of the vertices: what is added to a group comes in the same order in every range.
    sort_ascending(added.begin(), added.end());
    for (size_t i = 0; i < added.size();) {
      NormalPlan::Area area{{added[i].vertex[0], added[i].vertex[1], added[i].vertex[2]},
                            {kRange, kRange, kRange}};
      const size_t begin = i;
      for (; i < std::min(begin + 3, added.size()) && added[i].vertex == added[begin].vertex; ++i)
        area.to[i - begin] = added[i].to;
      plan->areas.push_back(area);
    }
    plan->range_begin.push_back(static_cast<uint32_t>(plan->areas.size()));
  }
}

void compute_normals(const NormalPlan& plan, const float* pose, size_t stride, uint32_t first,
                     uint32_t count, const VertexOutput& output) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(pose);
  VertexOutput rest = output;
  for (uint32_t end = first + count; first < end;) {
    const uint32_t range = first / kRange, n = std::min((range + 1) * kRange, end) - first;
    Float4 sums[kRange + 1] = {};
    sum_areas(plan, range, bytes, stride, sums);
    float blocks[3 * kRange];
    for (uint32_t i = 0; i < n; ++i) {
      const Float4& sum = sums[plan.local[first + i]];
      for (uint32_t c = 0; c < 3; ++c)
        blocks[(i / kBlock * 3 + c) * kBlock + i % kBlock] = sum[c + 1];
    }
    for (uint32_t i = n; i % kBlock != 0; ++i) {
      for (uint32_t c = 0; c < 3; ++c)
        blocks[(i / kBlock * 3 + c) * kBlock + i % kBlock] = 0;
    }
    normalise(blocks, n);
    store_points(blocks, 0, n, rest);
    rest.data = static_cast<unsigned char*>(rest.data) + rest.stride * n;
    first += n;
  }
}

}  // namespace anicodec
