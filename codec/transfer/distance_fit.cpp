// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/distance_fit.h"

#include "codec/massage/untangle.h"
#include "codec/surface/surface_samples.h"
#include "codec/transfer/block_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kIndexEvery = 5;       // rounds
constexpr double kFar = 0.52;        // of the largest distance at the start
constexpr double kMostGain = 4;      // of a sample's weight in a round
constexpr double kLoss = 0.9;        // the same of one that is near
constexpr double kMostWeight = 1e6;  // of a sample
constexpr double kPower = 1.3;       // of the distances, of which the sum is to be least
constexpr double kNearest = 0.1;     // distance in the mean one that counts as none
constexpr double kSofter = 0.93, kStiffer = 1.1;  // of the stiffness, in a round
constexpr double kDamping = 1e-6;
constexpr double kSolveTolerance = 1e-3;
constexpr int kMostIterations = 100;

/// A sample and the closest point of the other surface.
struct Pair {
  SurfacePoint on_mesh;
  Vector3d target = Vector3d::Zero();
  Vector3d direction = Vector3d::Zero();  ///< unit, of the distance
  double distance = 0;
};

/// The samples of one surface against the other.
struct SurfacePairs {
  std::vector<SurfaceSample> samples;
  std::vector<double> shares;
  std::vector<uint32_t> starts;  ///< where walks on the other surface start
  std::vector<double> weights;   ///< Lawson's
  std::vector<Pair> pairs;

  explicit SurfacePairs(const SurfaceTopology& topology)
      : samples(surface_samples(topology)),
        starts(samples.size(), SurfaceTopology::kNone),
        weights(samples.size(), 1),
        pairs(samples.size()) {}

  double mean() const {
    double sum = 0;
    for (size_t s = 0; s < samples.size(); ++s)
      sum += shares[s] * pairs[s].distance;
    return sum;
  }

  double max() const {
    double result = 0;
    for (const Pair& pair : pairs)
      result = std::max(result, pair.distance);
    return result;
  }
};

/// One mesh being fitted.
class DistanceSolver {
 public:
  DistanceSolver(const SurfaceTopology& mesh, const RigidShape& shape, const Surface& surface,
                 Positions* v)
      : mesh_(mesh),
        shape_(shape),
        surface_(surface),
        v_(*v),
        from_mesh_(mesh),
        from_surface_(surface.topology()),
        system_(mesh),
        rotations_(mesh.vertex_count, Matrix3d::Identity()) {
    from_surface_.shares =
        sample_shares(surface.topology(), from_surface_.samples, surface.positions());
  }

  Convergence run(const DistanceFitOptions& options) {
    Convergence result;
    Positions best = v_;
    double least = std::numeric_limits<double>::infinity(), mean = 0, max = 0;
    const double edge = mean_edge(mesh_, v_);
    double last_stiffness = options.last_stiffness;
    for (int round = 0;; ++round) {
      const bool by_index = round % kIndexEvery == 0 || round == options.rounds;
      const bool counts = round > 0 && by_index && 2 * round >= options.rounds;
      if (counts)
        untangle(mesh_, surface_, &v_);
      update(by_index);
      if (round == 0) {
        mean = largest_mean();
        max = largest();
        if (!(mean > 0))
          break;
      }
      const double score = std::max(largest_mean() / mean, largest() / max);
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
        const bool mean_lags = largest_mean() / mean > largest() / max;
        last_stiffness = std::clamp(last_stiffness * (mean_lags ? kSofter : kStiffer),
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
  double largest_mean() const { return std::max(from_mesh_.mean(), from_surface_.mean()); }

  double largest() const { return std::max(from_mesh_.max(), from_surface_.max()); }

  void update(bool by_index) {
    Surface moving(mesh_, v_);
    if (by_index)
      moving.build_index();
    from_mesh_.shares = sample_shares(mesh_, from_mesh_.samples, v_);
    // Isolated: a caller that works on several frames at once must not be entered again meanwhile.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(size_t{0}, from_mesh_.samples.size(), [&](size_t s) {
        const SurfaceSample& sample = from_mesh_.samples[s];
        Pair& pair = from_mesh_.pairs[s];
        pair.on_mesh = {sample.triangle, sample.weights, sample_point(mesh_, sample, v_), 0};
        const SurfacePoint found =
            find(surface_, pair.on_mesh.position, by_index, &from_mesh_.starts[s]);
        pair.target = found.position;
        set_direction(found.triangle, &pair);
      });
      tbb::parallel_for(size_t{0}, from_surface_.samples.size(), [&](size_t s) {
        const SurfaceSample& sample = from_surface_.samples[s];
        Pair& pair = from_surface_.pairs[s];
        pair.target = sample_point(surface_.topology(), sample, surface_.positions());
        pair.on_mesh = find(moving, pair.target, by_index, &from_surface_.starts[s]);
        set_direction(sample.triangle, &pair);
      });
    });
  }

  static SurfacePoint find(const Surface& surface, const Vector3d& q, bool by_index,
                           uint32_t* start) {
    const SurfacePoint point = by_index ? surface.closest(q) : surface.walk(q, *start);
    *start = point.triangle;
    return point;
  }

  /// Where there is no distance to speak of, the normal of the surface serves.
  void set_direction(uint32_t triangle, Pair* pair) const {
    const Vector3d offset = pair->target - pair->on_mesh.position;
    pair->distance = offset.norm();
    const Vector3d normal =
        area_normal(surface_.positions(), surface_.topology().triangles[triangle]);
    pair->direction = pair->distance > 1e-6 * std::sqrt(normal.norm())
                          ? Vector3d(offset / pair->distance)
                          : Vector3d(normal.normalized());
  }

  void reweight(double far) {
    for (SurfacePairs* side : {&from_mesh_, &from_surface_}) {
      for (size_t s = 0; s < side->samples.size(); ++s) {
        const double part = side->pairs[s].distance / far;
        double& weight = side->weights[s];
        weight = part > 1 ? std::min(kMostWeight, weight * std::min(kMostGain, part * part * 2))
                          : std::max(1.0, weight * kLoss);
      }
    }
    const double a = from_mesh_.mean(), b = from_surface_.mean();
    if (a > 0 && b > 0)
      balance_ *= std::sqrt(b / a);
  }

  void add_pairs(const SurfacePairs& side, double importance, Positions* right) {
    const double typical = side.mean();
    for (size_t s = 0; s < side.samples.size(); ++s) {
      const Pair& pair = side.pairs[s];
      const Matrix3d across = pair.direction * pair.direction.transpose();
      const double power = std::pow(pair.distance / typical + kNearest, kPower - 2);
      const Matrix3d q = power * importance * side.shares[s] * side.weights[s] *
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
    add_pairs(from_mesh_, unit, &right);
    add_pairs(from_surface_, unit * balance_, &right);
    const Positions step = system_.solve(right, kSolveTolerance, kMostIterations);
    v_ += step;
    return step.norm() / std::sqrt(static_cast<double>(std::max<Index>(1, v_.rows())));
  }

  const SurfaceTopology& mesh_;
  const RigidShape& shape_;
  const Surface& surface_;
  Positions& v_;
  SurfacePairs from_mesh_, from_surface_;
  double along_ = 1;    ///< what a move across the direction of a distance counts
  double balance_ = 1;  ///< weight of from_surface_ in that of from_mesh_
  BlockSystem system_;
  std::vector<Matrix3d> rotations_;
};

}  // namespace

Convergence fit_distance(const SurfaceTopology& mesh, const RigidShape& shape,
                         const Surface& surface, const DistanceFitOptions& options, Positions* v) {
  return DistanceSolver(mesh, shape, surface, v).run(options);
}

}  // namespace anicodec
