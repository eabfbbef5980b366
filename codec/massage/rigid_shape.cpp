// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/rigid_shape.h"

#include "codec/algebra/rigid_motion.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLargestCotangent = 50;
constexpr double kLeastWeight = 0.05;

}  // namespace

std::vector<double> cotangent_weights(const SurfaceTopology& topology, const Positions& positions,
                                      double least) {
  const std::vector<std::array<uint32_t, 2>> list = edges(topology);
  std::vector<double> weights(list.size(), 0);
  for (const SurfaceTopology::Triangle& t : topology.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const Vector3d origin = row(positions, t[k]);
      const Vector3d e = row(positions, a) - origin, g = row(positions, b) - origin;
      const double sine = e.cross(g).norm(), cosine = e.dot(g);
      const double cotangent =
          cosine < kLargestCotangent * sine ? cosine / sine : kLargestCotangent;
      const std::array<uint32_t, 2> edge{std::min(a, b), std::max(a, b)};
      const auto place = std::lower_bound(list.begin(), list.end(), edge) - list.begin();
      weights[static_cast<size_t>(place)] += std::max(cotangent, -kLargestCotangent) / 2;
    }
  }
  for (double& w : weights)
    w = std::max(w, least);
  return weights;
}

RigidShape::RigidShape(const SurfaceTopology& topology, const Positions& reference)
    : first_(topology.vertex_count + size_t{1}, 0),
      total_(Eigen::VectorXd::Zero(topology.vertex_count)) {
  const std::vector<std::array<uint32_t, 2>> list = edges(topology);
  const std::vector<double> weights = cotangent_weights(topology, reference, kLeastWeight);
  for (uint32_t v = 0; v < topology.vertex_count; ++v)
    first_[v + 1] = first_[v] + topology.ring[v].size();
  spokes_.resize(first_.back());
  std::vector<size_t> next(first_.begin(), first_.end() - 1);
  for (size_t e = 0; e < list.size(); ++e) {
    const auto [a, b] = list[e];
    const Vector3d edge = row(reference, a) - row(reference, b);
    spokes_[next[a]++] = {b, weights[e], edge};
    spokes_[next[b]++] = {a, weights[e], -edge};
    total_[a] += weights[e];
    total_[b] += weights[e];
  }
}

void RigidShape::update_rotations(const Positions& v, std::vector<Matrix3d>* rotations) const {
  for (uint32_t i = 0; i < vertex_count(); ++i) {
    const Vector3d centre = row(v, i);
    Matrix3d products = Matrix3d::Zero();
    for (const Spoke& s : spokes(i))
      products += s.weight * (centre - row(v, s.end)) * s.edge.transpose();
    (*rotations)[i] = best_rotation(products, (*rotations)[i]);
  }
}

Positions RigidShape::half_gradient(const Positions& v, std::span<const Matrix3d> rotations) const {
  Positions out(v.rows(), 3);
  for (uint32_t i = 0; i < vertex_count(); ++i) {
    const Vector3d centre = row(v, i);
    Vector3d sum = Vector3d::Zero();
    for (const Spoke& s : spokes(i))
      sum += s.weight *
             ((centre - row(v, s.end)) - 0.5 * (rotations[i] * s.edge + rotations[s.end] * s.edge));
    out.row(static_cast<Index>(i)) = sum.transpose();
  }
  return out;
}

void RigidShape::apply_laplacian(const Positions& x, Positions* out) const {
  for (uint32_t i = 0; i < vertex_count(); ++i) {
    Vector3d sum = total_[i] * row(x, i);
    for (const Spoke& s : spokes(i))
      sum -= s.weight * row(x, s.end);
    out->row(static_cast<Index>(i)) = sum.transpose();
  }
}

}  // namespace anicodec
