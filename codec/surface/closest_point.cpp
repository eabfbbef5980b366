// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/closest_point.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>
#include <embree3/rtcore.h>

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
  std::vector<uint32_t> triangles;
  std::vector<Vector3d> vertices;
  // Embree sees the surface moved and scaled into [-1, 1]^3, so that it neither overflows nor loses
  // small surfaces far from the origin.
  Vector3d centre = Vector3d::Zero();
  double scale = 1;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Tree(std::span<const uint32_t> triangle_list, std::span<const float> positions);

  ~Tree() {
    if (scene != nullptr)
      rtcReleaseScene(scene);
    if (device != nullptr)
      rtcReleaseDevice(device);
  }

  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  uint32_t size() const {
    return static_cast<uint32_t>(triangles.empty() ? vertices.size() : triangles.size() / 3);
  }

  void normalise();
  void build();
  void bounds(uint32_t element, RTCBounds* out) const;
  /// Takes the element if it is closer than the best so far, or as close and before it.
  bool try_element(uint32_t element, const Vector3d& q, ClosestPoint* best) const;
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
  normalise();
  build();
}

void ClosestPointQuery::Tree::normalise() {
  double half = 0;
  for (Index axis = 0; axis < 3; ++axis) {
    auto [low, high] = std::minmax_element(
        vertices.begin(), vertices.end(),
        [axis](const Vector3d& a, const Vector3d& b) { return a[axis] < b[axis]; });
    centre[axis] = ((*low)[axis] + (*high)[axis]) / 2;
    half = std::max(half, ((*high)[axis] - (*low)[axis]) / 2);
  }
  scale = half > 0 ? 1 / half : 1;
}

void ClosestPointQuery::Tree::build() {
  device = rtcNewDevice(nullptr);
  if (device != nullptr)
    scene = rtcNewScene(device);
  if (scene == nullptr)
    throw Error(ErrorKind::kInternal, "Embree cannot be started");
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, size());
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* args) {
        static_cast<const Tree*>(args->geometryUserPtr)->bounds(args->primID, args->bounds_o);
      },
      nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    throw Error(ErrorKind::kInternal, "Embree cannot build its hierarchy");
}

void ClosestPointQuery::Tree::bounds(uint32_t element, RTCBounds* out) const {
  float* low = &out->lower_x;
  float* high = &out->upper_x;
  for (Index axis = 0; axis < 3; ++axis) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    auto include = [&](uint32_t v) {
      double x = (vertices[v][axis] - centre[axis]) * scale;
      least = std::min(least, x);
      most = std::max(most, x);
    };
    if (triangles.empty()) {
      include(element);
    } else {
      for (size_t corner = 0; corner < 3; ++corner)
        include(triangles[size_t{3} * element + corner]);
    }
    low[axis] = std::nextafter(static_cast<float>(least), -2.F);
    high[axis] = std::nextafter(static_cast<float>(most), 2.F);
  }
}

bool ClosestPointQuery::Tree::try_element(uint32_t element, const Vector3d& q,
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
    return false;
  *best = found;
  return true;
}

ClosestPointQuery::ClosestPointQuery(std::span<const uint32_t> triangles,
                                     std::span<const float> positions)
    : tree_(std::make_unique<Tree>(triangles, positions)) {}

ClosestPointQuery::~ClosestPointQuery() = default;
ClosestPointQuery::ClosestPointQuery(ClosestPointQuery&&) noexcept = default;
ClosestPointQuery& ClosestPointQuery::operator=(ClosestPointQuery&&) noexcept = default;

ClosestPoint ClosestPointQuery::operator()(const Vector3d& q) const {
  struct Context {
    const Tree* tree;
    const Vector3d* q;
    double margin;
    ClosestPoint best;
  };

  Context context{tree_.get(), &q, 0, {}};
  context.best.square_distance = std::numeric_limits<double>::infinity();
  context.best.element = std::numeric_limits<uint32_t>::max();
  RTCPointQuery query;
  double reach = 1;
  float* to = &query.x;
  for (Index axis = 0; axis < 3; ++axis) {
    double x = (q[axis] - tree_->centre[axis]) * tree_->scale;
    reach = std::max(reach, std::abs(x));
    to[axis] = static_cast<float>(x);
  }
  // So far away that single precision cannot tell the elements apart.
  if (!(reach < 1e6)) {
    for (uint32_t element = 0; element < tree_->size(); ++element)
      tree_->try_element(element, q, &context.best);
    return context.best;
  }
  query.time = 0;
  query.radius = std::numeric_limits<float>::infinity();
  // Sixteen units in the last place of the coordinates: more than rounding q and comparing boxes
  // can err.
  context.margin = reach * std::ldexp(1.0, -20);
  RTCPointQueryContext stack;
  rtcInitPointQueryContext(&stack);
  rtcPointQuery(
      tree_->scene, &query, &stack,
      [](RTCPointQueryFunctionArguments* args) {
        auto* c = static_cast<Context*>(args->userPtr);
        if (!c->tree->try_element(args->primID, *c->q, &c->best))
          return false;
        double distance = std::sqrt(c->best.square_distance) * c->tree->scale;
        auto radius = static_cast<float>(distance * (1 + std::ldexp(1.0, -20)) + c->margin);
        if (!(radius < args->query->radius))
          return false;
        args->query->radius = radius;
        return true;
      },
      &context);
  return context.best;
}

}  // namespace anicodec
