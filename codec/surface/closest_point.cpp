// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/closest_point.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// The sum in this order, whatever a library vectorises: equal distances stay equal.
double dot(const Vector3d& a, const Vector3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3d combination(const Vector3d& w, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return w[0] * a + w[1] * b + w[2] * c;
}

/// As AlignedBox has it, without its branches.
double square_distance(const Eigen::AlignedBox3d& box, const Vector3d& q) {
  const Vector3d outside = (box.min() - q).cwiseMax(q - box.max()).cwiseMax(0.0);
  return dot(outside, outside);
}

}  // namespace

std::vector<uint32_t> fan_triangles(const Polygons& polygons) {
  std::vector<uint32_t> triangles;
  triangles.reserve(polygons.corners.size());
  for (size_t p = 0; p < polygons.size(); ++p) {
    auto polygon = polygons[p];
    for (size_t c = 2; c < polygon.size(); ++c)
      triangles.insert(triangles.end(), {polygon[0], polygon[c - 1], polygon[c]});
  }
  return triangles;
}

// Every candidate is a convex combination of the corners, so a weight that rounding spoils (a
// sliver) can only make a distance too large. The sides that face the point are tried, and where
// rounding may hide one, all of them.
ClosestPoint closest_on_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                 const Vector3d& q) {
  constexpr double kSliver = 1e-8;  // square of the sine of the angle at a
  constexpr double kInside = 1e-9;  // weight from which the opposite side is surely no closer
  // Relative to q, so that small distances keep their digits.
  const Vector3d corner[3] = {a - q, b - q, c - q};
  ClosestPoint best;
  best.square_distance = std::numeric_limits<double>::infinity();
  auto consider = [&](const Vector3d& weights) {
    const Vector3d offset = combination(weights, corner[0], corner[1], corner[2]);
    const double square = dot(offset, offset);
    if (square < best.square_distance) {
      best.square_distance = square;
      best.weights = weights;
    }
  };
  const Vector3d ab = corner[1] - corner[0], ac = corner[2] - corner[0];
  const Vector3d normal = ab.cross(ac);
  const double area = dot(normal, normal);
  Vector3d inside(-1, -1, -1);  // the weights of the foot of the perpendicular
  if (area > 0) {
    inside[0] = dot(corner[1].cross(corner[2]), normal) / area;
    inside[1] = dot(corner[2].cross(corner[0]), normal) / area;
    inside[2] = 1 - inside[0] - inside[1];
  }
  const bool sliver = !(area > kSliver * dot(ab, ab) * dot(ac, ac));
  for (Index i = 0; i < 3; ++i) {
    const Index j = (i + 1) % 3;
    if (!sliver && inside[(i + 2) % 3] > kInside)
      continue;
    const Vector3d side = corner[j] - corner[i];
    const double length = dot(side, side);
    const double t = length > 0 ? std::clamp(-dot(corner[i], side) / length, 0.0, 1.0) : 0;
    Vector3d weights = Vector3d::Zero();
    weights[i] = 1 - t;
    weights[j] = t;
    consider(weights);
  }
  if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0)
    consider(inside);
  best.position = combination(best.weights, a, b, c);
  return best;
}

struct ClosestPointQuery::Tree {
  using Hierarchy = Eigen::KdBVH<double, 3, uint32_t>;

  std::vector<uint32_t> triangles;
  std::vector<Vector3d> vertices;
  Hierarchy hierarchy;

  Tree(std::span<const uint32_t> triangle_list, std::span<const float> positions);

  uint32_t size() const {
    return static_cast<uint32_t>(triangles.empty() ? vertices.size() : triangles.size() / 3);
  }

  Eigen::AlignedBox3d box_of(uint32_t element) const;
  /// Takes the element if it is closer than the best so far, or as close and before it.
  void try_element(uint32_t element, const Vector3d& q, ClosestPoint* best) const;
};

ClosestPointQuery::Tree::Tree(std::span<const uint32_t> triangle_list,
                              std::span<const float> positions)
    : triangles(triangle_list.begin(), triangle_list.end()) {
  for (size_t i = 0; i + 2 < positions.size(); i += 3) {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(positions[i + axis]))
        throw Error(ErrorKind::kInput,
                    "vertex " + std::to_string(i / 3) + " of a surface is not finite");
    }
    vertices.emplace_back(double{positions[i]}, double{positions[i + 1]}, double{positions[i + 2]});
  }
  if (vertices.empty())
    throw Error(ErrorKind::kInput, "a surface without vertices has no closest point");
  std::vector<uint32_t> elements(size());
  std::iota(elements.begin(), elements.end(), 0U);
  std::vector<Eigen::AlignedBox3d> boxes(size());
  std::ranges::transform(elements, boxes.begin(),
                         [this](uint32_t element) { return box_of(element); });
  hierarchy.init(elements.begin(), elements.end(), boxes.begin(), boxes.end());
}

Eigen::AlignedBox3d ClosestPointQuery::Tree::box_of(uint32_t element) const {
  if (triangles.empty())
    return Eigen::AlignedBox3d(vertices[element]);
  Eigen::AlignedBox3d box;
  for (size_t corner = 0; corner < 3; ++corner)
    box.extend(vertices[triangles[size_t{3} * element + corner]]);
  return box;
}

void ClosestPointQuery::Tree::try_element(uint32_t element, const Vector3d& q,
                                          ClosestPoint* best) const {
  ClosestPoint found;
  if (triangles.empty()) {
    found.position = vertices[element];
    const Vector3d offset = found.position - q;
    found.square_distance = dot(offset, offset);
    found.weights = Vector3d::UnitX();
  } else {
    const uint32_t* t = &triangles[size_t{3} * element];
    found = closest_on_triangle(vertices[t[0]], vertices[t[1]], vertices[t[2]], q);
  }
  found.element = element;
  if (found.square_distance > best->square_distance ||
      (found.square_distance == best->square_distance && element > best->element))
    return;
  *best = found;
}

ClosestPointQuery::ClosestPointQuery(std::span<const uint32_t> triangles,
                                     std::span<const float> positions)
    : tree_(std::make_unique<Tree>(triangles, positions)) {}

ClosestPointQuery::~ClosestPointQuery() = default;
ClosestPointQuery::ClosestPointQuery(ClosestPointQuery&&) noexcept = default;
ClosestPointQuery& ClosestPointQuery::operator=(ClosestPointQuery&&) noexcept = default;

ClosestPoint ClosestPointQuery::operator()(const Vector3d& q) const {
  // Halves of halves: as deep as an index has bits, one box waiting at each depth.
  constexpr size_t kDepth = 40;

  struct Waiting {
    double square_distance;
    Tree::Hierarchy::Index node;
  };

  const Tree::Hierarchy& hierarchy = tree_->hierarchy;
  ClosestPoint best;
  best.square_distance = std::numeric_limits<double>::infinity();
  best.element = std::numeric_limits<uint32_t>::max();
  // A box farther away than this holds nothing closer. The margin is of some units in the last place
  // of the numbers that the distance to a triangle is made of.
  double square_reach = best.square_distance;
  const double margin =
      std::ldexp(hierarchy.getRootIndex() < 0
                     ? 0
                     : (q - hierarchy.getVolume(hierarchy.getRootIndex()).center()).norm() +
                           hierarchy.getVolume(hierarchy.getRootIndex()).diagonal().norm(),
                 -48);
  std::array<Waiting, kDepth> stack;
  size_t waiting = 0;
  stack[waiting++] = {0, hierarchy.getRootIndex()};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.square_distance > square_reach)
      continue;
    Tree::Hierarchy::VolumeIterator box = nullptr, box_end = nullptr;
    Tree::Hierarchy::ObjectIterator element = nullptr, element_end = nullptr;
    hierarchy.getChildren(next.node, box, box_end, element, element_end);
    for (; element != element_end; ++element) {
      tree_->try_element(*element, q, &best);
      const double reach = std::sqrt(best.square_distance) + margin;
      square_reach = reach * reach;
    }
    Waiting children[2];
    size_t count = 0;
    for (; box != box_end; ++box) {
      const double square = square_distance(hierarchy.getVolume(*box), q);
      if (square <= square_reach)
        children[count++] = {square, *box};
    }
    if (count == 2 && children[0].square_distance < children[1].square_distance)
      std::swap(children[0], children[1]);  // the nearer one is looked at first
    for (size_t i = 0; i < count; ++i)
      stack[waiting++] = children[i];
  }
  return best;
}

}  // namespace anicodec
