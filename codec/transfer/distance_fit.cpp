// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/distance_fit.h"

#include "codec/massage/untangle.h"
#include "codec/transfer/block_system.h"
#include "codec/transfer/mutual_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kRoundsPerIndex = 5;
constexpr double kFar = 0.52;        // of the largest distance at the start
constexpr double kMostGain = 4;      // of a sample's weight in a round
constexpr double kLoss = 0.9;        // the same of one that is near
constexpr double kMostWeight = 1e6;  // of a sample
constexpr double kPower = 1.3;       // of the distances, of which the sum is to be least
constexpr double kNearest = 0.1;     // distance in the mean one that counts as none
constexpr double kSofterNextRound = 0.93, kStifferNextRound = 1.1;  // of the stiffness, in a round
constexpr int kMostSolverSteps = 100;

/// One mesh being fitted.
class DistanceSolver {
 public:
  DistanceSolver(const SurfaceTopology& mesh, const RigidShape& shape, const Surface& surface,
                 Positions* v)
      : mesh_(mesh),
        shape_(shape),
        surface_(surface),
        v_(*v),
        distance_(mesh, surface),
        mesh_weights_(distance_.from_mesh.samples.size(), 1),
        surface_weights_(distance_.from_surface.samples.size(), 1),
        system_(mesh),
        rotations_(mesh.vertex_count, Matrix3d::Identity()) {}

  Convergence run(const DistanceFitOptions& options) {
    Convergence result;
    Positions best = v_;
    double least = std::numeric_limits<double>::infinity(), mean = 0, max = 0;
    const double edge = mean_edge(mesh_, v_);
    double last_stiffness = options.last_stiffness;
    for (int round = 0;; ++round) {
      const bool by_index = round % kRoundsPerIndex == 0 || round == options.rounds;
      const bool counts = round > 0 && by_index && 2 * round >= options.rounds;
      if (counts)
        untangle(mesh_, surface_, &v_);
      update(by_index);
      if (round == 0) {
        mean = distance_.mean();
        max = distance_.max();
        if (!(mean > 0))
          break;
      }
      const double score = std::max(distance_.mean() / mean, distance_.max() / max);
      if (counts && score < least) {
        least = score;
        best = v_;
      }
      if (round == options.rounds)
        break;
      reweight(kFar * max);
      auto between = [&](double first, double last, double t) {
        return first * std::pow(last / first, std::clamp(t, 0.0, 1.0));
      };
      const double part = static_cast<double>(round) / options.rounds;
      along_ = between(options.first_along, options.last_along, 2 * part - 1);
      if (4 * round > options.rounds) {
        const bool mean_lags = distance_.mean() / mean > distance_.max() / max;
        last_stiffness =
            std::clamp(last_stiffness * (mean_lags ? kSofterNextRound : kStifferNextRound),
                       options.least_stiffness, options.last_stiffness);
      }
      const double step = move(between(options.first_stiffness, last_stiffness, 4 * part));
      result.step = edge > 0 ? step / edge : 0;
      ++result.rounds;
    }
    v_ = best;
    result.converged = result.step < 1e-2;
    return result;
  }

 private:
  void update(bool by_index) { distance_.update(v_, by_index); }

  void reweight(double far) {
    auto reweigh = [far](const SampledSide& side, std::vector<double>& weights) {
      for (size_t s = 0; s < weights.size(); ++s) {
        const double part = side.pairs[s].distance / far;
        weights[s] = part > 1
                         ? std::min(kMostWeight, weights[s] * std::min(kMostGain, part * part * 2))
                         : std::max(1.0, weights[s] * kLoss);
      }
    };
    reweigh(distance_.from_mesh, mesh_weights_);
    reweigh(distance_.from_surface, surface_weights_);
    const double a = distance_.from_mesh.mean(), b = distance_.from_surface.mean();
    if (a > 0 && b > 0)
      balance_ *= std::sqrt(b / a);
  }

  void add_pairs(const SampledSide& side, const std::vector<double>& weights, double importance,
                 Positions* right) {
    const double typical = side.mean();
    for (size_t s = 0; s < side.samples.size(); ++s) {
      const SamplePair& pair = side.pairs[s];
      const Matrix3d across = pair.direction * pair.direction.transpose();
      const double power = std::pow(pair.distance / typical + kNearest, kPower - 2);
      const Matrix3d q = power * importance * side.shares[s] * weights[s] *
                         ((1 - along_) * across + along_ * Matrix3d::Identity());
      const Vector3d pull = q * (pair.target - pair.on_mesh.position);
      const SurfaceTopology::Triangle& corners = mesh_.triangles[pair.on_mesh.triangle];
      for (size_t a = 0; a < 3; ++a) {
        const double wa = pair.on_mesh.weights[static_cast<Index>(a)];
        if (wa == 0)
          continue;
        right->row(static_cast<Index>(corners[a])) += wa * pull.transpose();
        system_.add_diagonal(corners[a], wa * wa * q);
        for (size_t b = a + 1; b < 3; ++b) {
          const double wb = pair.on_mesh.weights[static_cast<Index>(b)];
          if (wb != 0)
            system_.add_edge(corners[a], corners[b], wa * wb * q);
        }
      }
    }
  }

  /// One step. Returns its root mean square length.
  double move(double stiffness) {
    shape_.update_rotations(v_, &rotations_);
    system_.clear();
    for (uint32_t i = 0; i < mesh_.vertex_count; ++i) {
      const double total = stiffness * shape_.total_weight()[static_cast<Index>(i)] + kDamping;
      system_.add_diagonal(i, total * Matrix3d::Identity());
      for (const RigidShape::Spoke& spoke : shape_.spokes(i)) {
        if (spoke.end > i)
          system_.add_edge(i, spoke.end, -stiffness * spoke.weight * Matrix3d::Identity());
      }
    }
    Positions right = -stiffness * shape_.half_gradient(v_, rotations_);
    const auto unit = static_cast<double>(mesh_.vertex_count);
    add_pairs(distance_.from_mesh, mesh_weights_, unit, &right);
    add_pairs(distance_.from_surface, surface_weights_, unit * balance_, &right);
    const Positions step = system_.solve(right, kSolveTolerance, kMostSolverSteps);
    v_ += step;
    return step.norm() / std::sqrt(static_cast<double>(std::max<Index>(1, v_.rows())));
  }

  const SurfaceTopology& mesh_;
  const RigidShape& shape_;
  const Surface& surface_;
  Positions& v_;
  MutualDistance distance_;
  std::vector<double> mesh_weights_, surface_weights_;  ///< of the samples, Lawson's
  double along_ = 1;    ///< what a move across the direction of a distance counts
  double balance_ = 1;  ///< weight of the samples of the surface in that of the mesh's
  BlockSystem system_;
  std::vector<Matrix3d> rotations_;
};

}  // namespace

Convergence fit_distance(const SurfaceTopology& mesh, const RigidShape& shape,
                         const Surface& surface, const DistanceFitOptions& options, Positions* v) {
  return DistanceSolver(mesh, shape, surface, v).run(options);
}

}  // namespace anicodec
