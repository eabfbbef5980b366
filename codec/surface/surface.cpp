// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kSmoothCosine = 0.866;  // 30 degrees, of a vertex normal from a triangle's

}  // namespace

Positions positions_of(std::span<const float> frame) {
  const Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>> floats(
      frame.data(), static_cast<Index>(frame.size() / 3), 3);
  return floats.cast<double>();
}

Vector3d float_position(const Vector3d& p) {
  // Volatile: GCC 12 vectorises a pair of conversions to float and back into none at all.
  Vector3d result;
  for (Index k = 0; k < 3; ++k) {
    const volatile float rounded = static_cast<float>(p[k]);
    result[k] = double{rounded};
  }
  return result;
}

Vector3d area_normal(const Positions& positions, const SurfaceTopology::Triangle& triangle) {
  const Vector3d a = row(positions, triangle[0]);
  return (row(positions, triangle[1]) - a).cross(row(positions, triangle[2]) - a);
}

Positions vertex_normals(const SurfaceTopology& topology, const Positions& positions) {
  Positions normals = Positions::Zero(positions.rows(), 3);
  for (const SurfaceTopology::Triangle& t : topology.triangles) {
    Vector3d normal = area_normal(positions, t);
    const double length = normal.norm();
    if (!(length > 0))
      continue;
    normal /= length;
    const Vector3d p[3] = {row(positions, t[0]), row(positions, t[1]), row(positions, t[2])};
    for (size_t k = 0; k < 3; ++k) {
      const double angle = std::atan2(length, (p[(k + 1) % 3] - p[k]).dot(p[(k + 2) % 3] - p[k]));
      normals.row(static_cast<Index>(t[k])) += angle * normal.transpose();
    }
  }
  for (Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0)
      normals.row(v) /= length;
  }
  return normals;
}

double mean_edge(const SurfaceTopology& topology, const Positions& positions) {
  double sum = 0;
  size_t count = 0;
  for (uint32_t v = 0; v < topology.vertex_count; ++v) {
    for (uint32_t w : topology.ring[v]) {
      if (v < w) {
        sum += (row(positions, v) - row(positions, w)).norm();
        ++count;
      }
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

Eigen::VectorXd ring_sizes(const SurfaceTopology& topology, const Positions& positions) {
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(positions.rows());
  for (uint32_t v = 0; v < topology.vertex_count; ++v) {
    double sum = 0;
    for (uint32_t w : topology.ring[v])
      sum += (row(positions, v) - row(positions, w)).norm();
    if (sum > 0)
      sizes[static_cast<Index>(v)] = sum / static_cast<double>(topology.ring[v].size());
  }
  return sizes;
}

Surface::Surface(const SurfaceTopology& topology, Positions positions)
    : topology_(&topology),
      positions_(std::move(positions)),
      normals_(vertex_normals(topology, positions_)) {}

void Surface::build_index() {
  if (topology_->triangles.empty())
    throw Error(ErrorKind::kInput, "a surface without triangles cannot be massaged");
  boundary_.clear();
  std::vector<uint32_t> corners, boundary;
  for (uint32_t t = 0; t < topology_->triangles.size(); ++t) {
    const SurfaceTopology::Triangle& corner = topology_->triangles[t];
    corners.insert(corners.end(), corner.begin(), corner.end());
    for (size_t k = 0; k < 3; ++k) {
      // An edge is a triangle without area.
      if (topology_->across[t][k] != SurfaceTopology::kNone)
        continue;
      const uint32_t a = corner[(k + 1) % 3], b = corner[(k + 2) % 3];
      boundary_.push_back({a, b});
      boundary.insert(boundary.end(), {a, b, b});
    }
  }
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> floats = positions_.cast<float>();
  const std::span<const float> coordinates(floats.data(), static_cast<size_t>(floats.size()));
  index_ = std::make_unique<ClosestPointQuery>(corners, coordinates);
  if (!boundary.empty())
    boundary_index_ = std::make_unique<ClosestPointQuery>(boundary, coordinates);
}

Vector3d Surface::closest_on_boundary(const Vector3d& q, Vector3d* direction) const {
  const ClosestPoint found = (*boundary_index_)(q);
  const auto [a, b] = boundary_[found.element];
  *direction = (row(positions_, b) - row(positions_, a)).normalized();
  return found.position;
}

SurfacePoint Surface::closest(const Vector3d& q) const {
  // The index holds floats; the point itself is exact in double again.
  return closest_on((*index_)(q).element, q);
}

SurfacePoint Surface::closest_on(uint32_t triangle, const Vector3d& q) const {
  const SurfaceTopology::Triangle& t = topology_->triangles[triangle];
  const ClosestPoint found =
      closest_on_triangle(row(positions_, t[0]), row(positions_, t[1]), row(positions_, t[2]), q);
  return {triangle, found.weights, found.position, found.square_distance};
}

SurfacePoint Surface::walk(const Vector3d& q, uint32_t start) const {
  SurfacePoint best = closest_on(start, q);
  // Every step makes the distance smaller by a factor, so this ends by itself; the bound is for
  // very large meshes.
  for (int step = 0; step < 10000; ++step) {
    const uint32_t here = best.triangle;
    const double bound = best.square_distance * (1 - 1e-12);
    int zeros = 0;
    size_t positive = 0, zero = 0;
    for (size_t k = 0; k < 3; ++k) {
      if (best.weights[static_cast<Index>(k)] <= 0) {
        ++zeros;
        zero = k;
      } else {
        positive = k;
      }
    }
    if (zeros == 0)
      break;
    SurfacePoint next = best;
    auto consider = [&](uint32_t t) {
      const SurfacePoint other = closest_on(t, q);
      if (other.square_distance < next.square_distance)
        next = other;
    };
    if (zeros == 1) {
      const uint32_t other = topology_->across[here][zero];
      if (other == SurfaceTopology::kNone)
        break;
      consider(other);
    } else {
      for (uint32_t t : topology_->star[topology_->triangles[here][positive]])
        consider(t);
    }
    if (!(next.square_distance < bound))
      break;
    best = next;
  }
  return best;
}

SurfacePoint Surface::walk_boundary(const Vector3d& q, uint32_t* start, Vector3d* direction) const {
  const auto& neighbours = topology_->boundary_neighbours;
  SurfacePoint best;
  best.square_distance = std::numeric_limits<double>::infinity();
  uint32_t here = *start;
  for (uint32_t step = 0; step <= topology_->vertex_count; ++step) {
    const double bound = best.square_distance * (1 - 1e-12);
    uint32_t next = here;
    for (uint32_t end : neighbours[here]) {
      if (end == SurfaceTopology::kNone)
        continue;
      const Vector3d a = row(positions_, here), side = row(positions_, end) - a;
      const double length = side.squaredNorm();
      const double t = length > 0 ? std::clamp(side.dot(q - a) / length, 0.0, 1.0) : 0;
      const double square = (a + t * side - q).squaredNorm();
      if (square < best.square_distance) {
        best.square_distance = square;
        best.position = a + t * side;
        *direction = length > 0 ? Vector3d(side / std::sqrt(length)) : Vector3d::Zero();
        next = t > 0.5 && topology_->kind[end] == VertexKind::kBoundary ? end : here;
      }
    }
    if (next == here || !(best.square_distance < bound))
      break;
    here = next;
  }
  *start = here;
  return best;
}

Vector3d Surface::normal(const SurfacePoint& point) const {
  const SurfaceTopology::Triangle& t = topology_->triangles[point.triangle];
  const Vector3d sum = point.weights[0] * row(normals_, t[0]) +
                       point.weights[1] * row(normals_, t[1]) +
                       point.weights[2] * row(normals_, t[2]);
  const double length = sum.norm();
  return length > 0 ? Vector3d(sum / length) : Vector3d::Zero();
}

Vector3d Surface::curved(const SurfacePoint& point) const {
  const SurfaceTopology::Triangle& t = topology_->triangles[point.triangle];
  Vector3d p[3], n[3];
  const Vector3d flat = area_normal(positions_, t).normalized();
  for (size_t k = 0; k < 3; ++k) {
    p[k] = row(positions_, t[k]);
    n[k] = row(normals_, t[k]);
    if (n[k].dot(flat) < kSmoothCosine)
      return point.position;
  }
  // The control points on the sides, each nearer to its first corner, as offsets from the triangle.
  Vector3d side[3][3];
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      if (i != j) {
        side[i][j] = -(p[j] - p[i]).dot(n[i]) / 3 * n[i];
        sum += side[i][j];
      }
    }
  }
  const Vector3d middle = sum / 4;  // E + (E - V) / 2 of the paper, as an offset
  const Vector3d& w = point.weights;
  Vector3d result = point.position + 6 * w[0] * w[1] * w[2] * middle;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      if (i != j) {
        const double wi = w[static_cast<Index>(i)], wj = w[static_cast<Index>(j)];
        result += 3 * wi * wi * wj * side[i][j];
      }
    }
  }
  return result;
}

bool Surface::on_boundary(const SurfacePoint& point) const {
  for (size_t k = 0; k < 3; ++k) {
    if (point.weights[static_cast<Index>(k)] <= 0 &&
        topology_->across[point.triangle][k] == SurfaceTopology::kNone)
      return true;
  }
  return false;
}

}  // namespace anicodec
