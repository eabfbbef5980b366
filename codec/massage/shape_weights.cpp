// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/shape_weights.h"

#include "codec/massage/sliding_solver.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kLeastAngle = 1e-6, kLargestAngle = 3.14;  // of a corner, flattened
constexpr double kCappedAngle = 3.1;                        // of a corner in space
constexpr double kLeastLength = 1e-6;                       // of an edge, in mean edges
constexpr double kLeastHarmonic = 1e-2;                     // of the ring's mean weight

/// The weights of one row, by the neighbour's place in the ring.
class RingWeights {
 public:
  RingWeights(const SurfaceTopology& topology, const Positions& reference, uint32_t centre,
              double mean_edge_length)
      : topology_(topology),
        reference_(reference),
        centre_(centre),
        least_length_(kLeastLength * mean_edge_length),
        weights_(topology.ring[centre].size(), 0.0) {}

  const std::vector<double>& uniform() {
    std::fill(weights_.begin(), weights_.end(), 1.0);
    return weights_;
  }

  const std::vector<double>& mean_value(const Vector3d& normal) {
    if (!(normal.squaredNorm() > 0) || !add_flattened(normal)) {
      std::fill(weights_.begin(), weights_.end(), 0.0);
      for_corners([&](uint32_t j, uint32_t k) {
        const Vector3d e = spoke(j), g = spoke(k);
        add(j, k, std::min(std::atan2(e.cross(g).norm(), e.dot(g)), kCappedAngle), e, g);
      });
    }
    return weights_;
  }

  const std::vector<double>& harmonic() {
    for_corners([&](uint32_t j, uint32_t k) {
      weights_[place(j)] += cotangent(k, j);
      weights_[place(k)] += cotangent(j, k);
    });
    double sum = 0;
    for (double w : weights_)
      sum += std::abs(w);
    const double least = kLeastHarmonic * sum / static_cast<double>(weights_.size());
    for (double& w : weights_)
      w = std::max(w, least);
    return weights_;
  }

 private:
  Vector3d spoke(uint32_t j) const { return row(reference_, j) - row(reference_, centre_); }

  size_t place(uint32_t j) const {
    const auto ring = topology_.ring[centre_];
    return static_cast<size_t>(std::lower_bound(ring.begin(), ring.end(), j) - ring.begin());
  }

  /// Calls with the two other corners of every triangle around, in its order.
  template <class Visit>
  void for_corners(const Visit& visit) const {
    for (uint32_t t : topology_.star[centre_]) {
      const SurfaceTopology::Triangle& corner = topology_.triangles[t];
      for (size_t c = 0; c < 3; ++c) {
        if (corner[c] == centre_)
          visit(corner[(c + 1) % 3], corner[(c + 2) % 3]);
      }
    }
  }

  void add(uint32_t j, uint32_t k, double angle, const Vector3d& e, const Vector3d& g) {
    const double tangent = std::tan(angle / 2);
    weights_[place(j)] += tangent / std::max(e.norm(), least_length_);
    weights_[place(k)] += tangent / std::max(g.norm(), least_length_);
  }

  /// False where the ring folds.
  bool add_flattened(const Vector3d& normal) {
    bool plain = true;
    for_corners([&](uint32_t j, uint32_t k) {
      Vector3d e = spoke(j), g = spoke(k);
      e -= normal * normal.dot(e);
      g -= normal * normal.dot(g);
      const double angle = std::atan2(normal.dot(e.cross(g)), e.dot(g));
      plain = plain && angle > kLeastAngle && angle < kLargestAngle;
      if (plain)
        add(j, k, angle, e, g);
    });
    return plain;
  }

  /// Cotangent of the angle at `at` between the centre and `other`.
  double cotangent(uint32_t at, uint32_t other) const {
    const Vector3d e = -spoke(at), g = row(reference_, other) - row(reference_, at);
    const double sine = e.cross(g).norm(), cosine = e.dot(g);
    return std::clamp(cosine / std::max(sine, 1e-4 * e.norm() * g.norm()), -1e4, 1e4);
  }

  const SurfaceTopology& topology_;
  const Positions& reference_;
  uint32_t centre_;
  double least_length_;
  std::vector<double> weights_;
};

}  // namespace

RowMatrix shape_matrix(const SurfaceTopology& topology, const Positions& reference,
                       ShapeWeights weights) {
  const Positions normals = vertex_normals(topology, reference);
  const double edge = mean_edge(topology, reference);
  const std::vector<uint8_t> freedom = sliding_freedom(topology, reference);
  RowMatrix matrix(topology.vertex_count, topology.vertex_count);
  std::vector<Eigen::Triplet<double>> entries;
  for (uint32_t i = 0; i < topology.vertex_count; ++i) {
    const auto here = static_cast<Index>(i);
    if (freedom[i] == 0)
      continue;
    if (freedom[i] == 1) {
      const auto [a, b] = topology.boundary_neighbours[i];
      const double to_a = (row(reference, a) - row(reference, i)).norm();
      const double to_b = (row(reference, b) - row(reference, i)).norm();
      const double share = to_a + to_b > 0 ? to_b / (to_a + to_b) : 0.5;
      entries.emplace_back(here, here, 1.0);
      entries.emplace_back(here, static_cast<Index>(a), -share);
      entries.emplace_back(here, static_cast<Index>(b), share - 1);
      continue;
    }
    RingWeights ring(topology, reference, i, edge);
    const std::vector<double>& w = weights == ShapeWeights::kUniform ? ring.uniform()
                                   : weights == ShapeWeights::kMeanValue
                                       ? ring.mean_value(row(normals, i))
                                       : ring.harmonic();
    double sum = 0;
    for (double x : w)
      sum += x;
    if (!(sum > 0) || !std::isfinite(sum))
      continue;
    entries.emplace_back(here, here, 1.0);
    for (size_t n = 0; n < w.size(); ++n)
      entries.emplace_back(here, static_cast<Index>(topology.ring[i][n]), -w[n] / sum);
  }
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace anicodec
