// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/block_system.h"

#include <algorithm>

#include <Eigen/LU>

namespace anicodec {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

BlockSystem::BlockSystem(const SurfaceTopology& topology)
    : topology_(&topology), first_(size_t{topology.vertex_count} + 1, 0) {
  for (uint32_t i = 0; i < topology.vertex_count; ++i)
    first_[i + 1] = first_[i] + topology.ring[i].size();
  clear();
}

void BlockSystem::clear() {
  diagonal_.assign(topology_->vertex_count, Matrix3d::Zero());
  edges_.assign(first_.back(), Matrix3d::Zero());
}

void BlockSystem::add_edge(uint32_t i, uint32_t j, const Matrix3d& block) {
  for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i)}) {
    const auto ring = topology_->ring[from];
    const auto place = std::lower_bound(ring.begin(), ring.end(), to) - ring.begin();
    edges_[first_[from] + static_cast<size_t>(place)] += block;
  }
}

void BlockSystem::apply(const Positions& x, Positions* out) const {
  for (uint32_t i = 0; i < topology_->vertex_count; ++i) {
    Vector3d sum = diagonal_[i] * row(x, i);
    const Matrix3d* block = edges_.data() + first_[i];
    for (uint32_t j : topology_->ring[i])
      sum += *block++ * row(x, j);
    out->row(static_cast<Index>(i)) = sum.transpose();
  }
}

Positions BlockSystem::solve(const Positions& right, double tolerance, int most_iterations) const {
  std::vector<Matrix3d> inverse(topology_->vertex_count, Matrix3d::Identity());
  for (uint32_t i = 0; i < topology_->vertex_count; ++i) {
    const double size = diagonal_[i].trace();
    if (size > 0)
      inverse[i] = (diagonal_[i] + 1e-9 * size * Matrix3d::Identity()).inverse();
  }
  auto precondition = [&](const Positions& x, Positions* out) {
    for (uint32_t i = 0; i < topology_->vertex_count; ++i)
      out->row(static_cast<Index>(i)) = (inverse[i] * row(x, i)).transpose();
  };
  Positions result = Positions::Zero(right.rows(), 3), residual = right;
  Positions scaled(right.rows(), 3), image(right.rows(), 3);
  precondition(residual, &scaled);
  Positions direction = scaled;
  double product = residual.cwiseProduct(scaled).sum();
  const double goal = product * tolerance * tolerance;
  for (int k = 0; k < most_iterations && product > goal && product > 0; ++k) {
    apply(direction, &image);
    const double curvature = direction.cwiseProduct(image).sum();
    if (!(curvature > 0))
      break;
    const double factor = product / curvature;
    result += factor * direction;
    residual -= factor * image;
    precondition(residual, &scaled);
    const double next = residual.cwiseProduct(scaled).sum();
    direction = scaled + (next / product) * direction;
    product = next;
  }
  return result;
}

}  // namespace anicodec
