// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/close_fit.h"

#include "codec/massage/rigid_shape.h"
#include "codec/massage/untangle.h"
#include "codec/surface/mesh_quality.h"
#include "codec/transfer/block_system.h"
#include "codec/transfer/mutual_distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Found by trials on a standing horse decimated to 3 to 20 % by the edge collapses of three programs
// (`anicodec massage fit`): least parts of the mean that are left while the maximum falls below 0.6.
constexpr int kRounds = 150;      // of a descent
constexpr int kMostDescents = 5;  // while more than kEnough is left
constexpr double kBound = 0.57;   // see close_fit.h
constexpr double kGoal = 0.58;    // of the largest, that the weight is for
// Part of mean and largest: from here on fewer turned triangles are better.
constexpr double kEnough = 0.6;
constexpr int kHeldRounds = 20;  // in which no triangle may turn, however far off it is
constexpr double kFirstWeight = 0.1, kWeightGrowth = 1.15;  // in a round
constexpr double kSharpness = 24;  // of the larger of the two means: a norm of this power
constexpr double kAlong = 1e-3;    // what a move along the surface counts in one across it
// A distance counts linearly beyond this part of the mean, quadratically below.
constexpr double kFirstLinear = 0.7, kLastLinear = 0.04;
constexpr double kLinearRounds = 0.7;  // of all, in which it falls
constexpr double kFirstStiffness = 1e-3, kLeastStiffness = 1e-7, kSofter = 0.8;
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-9, kLess = 0.5, kMore = 4;
constexpr int kAttempts = 10;  // in a round
constexpr int kMostStuck = 4;  // rounds without a step, about one after the other
constexpr int kUntangleEvery = 10;
constexpr int kProgressRounds = 20;
constexpr int kFirstEnd = 90;       // not before that
constexpr double kProgress = 1e-3;  // of the value, in these rounds; with less it is over
constexpr int kMostIterations = 100;

/// The merit that is minimised, in parts of the mean and the largest distance at the start.
struct Merit {
  double mean = 0;    ///< the larger, smoothed
  double beyond = 0;  ///< sum of squares of what is beyond the bound

  double value(double weight) const { return mean + weight * beyond; }
};

class CloseFit {
 public:
  CloseFit(const SurfaceTopology& mesh, const Surface& surface, Positions* v)
      : mesh_(mesh),
        surface_(surface),
        v_(*v),
        shape_(mesh, *v),
        distance_(mesh, surface),
        system_(mesh),
        rotations_(mesh.vertex_count, Matrix3d::Identity()) {}

  Convergence run() {
    Convergence result;
    distance_.update(v_, true);
    mean_ = distance_.mean();
    max_ = distance_.max();
    edge_ = mean_edge(mesh_, v_);
    constexpr double kNothing = 1e-9;  // of an edge: rounding
    if (!(mean_ > kNothing * edge_))
      return result;
    best_ = v_;
    least_turned_ = first_turned_ = turned();
    if (untangle(mesh_, surface_, &v_) > 0)
      distance_.update(v_, true);
    descend(&result);
    // A fit that came close by turned triangles goes on without them, now from the best, now from
    // where it ended.
    for (int k = 1; k < kMostDescents && least_score_ > kEnough; ++k) {
      if (k % 2 == 1)
        v_ = best_;
      else
        untangle(mesh_, surface_, &v_);
      distance_.update(v_, true);
      damping_ = kFirstDamping;
      stiffness_ = kFirstStiffness;
      descend(&result);
    }
    v_ = best_;
    return result;
  }

 private:
  /// Steps until they lower the merit by little.
  void descend(Convergence* result) {
    int stuck = 0;
    std::vector<double> scores;
    for (int round = 0; round < kRounds && stuck <= kMostStuck; ++round) {
      holds_ = round < kHeldRounds || distance_.max() <= kEnough * max_;
      set_linear(round);
      assemble();
      const double step = move();
      ++result->rounds;
      if (step > 0) {
        result->step = edge_ > 0 ? step / edge_ : 0;
        stuck -= stuck > 0 && round % 8 == 0 ? 1 : 0;
        if (distance_.max() > kGoal * max_)
          weight_ *= kWeightGrowth;
      } else {
        damping_ = kFirstDamping * std::pow(10, stuck++ - 1);
      }
      if (round % kUntangleEvery == kUntangleEvery - 1 || round == kRounds - 1)
        take_best();
      scores.push_back(std::max(distance_.mean() / mean_, distance_.max() / max_));
      result->converged = round >= kFirstEnd &&
                          scores.back() > (1 - kProgress) * scores[scores.size() - kProgressRounds];
      if (result->converged)
        break;
    }
    take_best();
  }

  void set_linear(int round) {
    const double part = std::min(1.0, round / (kLinearRounds * kRounds));
    linear_ = kFirstLinear * std::pow(kLastLinear / kFirstLinear, part);
  }

  size_t turned() const { return turned_triangles(mesh_, v_, surface_).size(); }

  Merit merit() const {
    Merit merit;
    for (const SampledSide* side : {&distance_.from_mesh, &distance_.from_surface}) {
      merit.mean += std::pow(side->mean() / mean_, kSharpness);
      for (const SamplePair& pair : side->pairs) {
        const double beyond = std::max(0.0, pair.distance / max_ - kBound);
        merit.beyond += beyond * beyond;
      }
    }
    merit.mean = std::pow(merit.mean, 1 / kSharpness);
    return merit;
  }

  bool is_better(size_t turned_now, double score) const {
    if (score >= 1 || turned_now > first_turned_)
      return false;
    const bool is_enough = score <= kEnough, was_enough = least_score_ <= kEnough;
    if (is_enough != was_enough)
      return is_enough;
    return turned_now < least_turned_ || (turned_now == least_turned_ && score < least_score_);
  }

  /// Turns what has turned, and keeps the positions if they are the best so far. Goes on from them
  /// unless that costs much.
  void take_best() {
    const Positions before = v_;
    const double value = merit().value(weight_);
    if (untangle(mesh_, surface_, &v_) > 0)
      distance_.update(v_, true);
    const size_t turned_now = turned();
    const double score = std::max(distance_.mean() / mean_, distance_.max() / max_);
    if (is_better(turned_now, score)) {
      least_turned_ = turned_now;
      least_score_ = score;
      best_ = v_;
    }
    constexpr double kDear = 1.05;
    if (merit().value(weight_) > kDear * value) {
      v_ = before;
      distance_.update(v_, true);
    }
  }

  /// Derivatives of the merit by the distances, as a system of springs from the samples to their
  /// closest points.
  void assemble() {
    system_.clear();
    right_ = Positions::Zero(v_.rows(), 3);
    const Merit now = merit();
    for (const SampledSide* side : {&distance_.from_mesh, &distance_.from_surface}) {
      const double mean = side->mean();
      const double importance = std::pow(mean / mean_ / now.mean, kSharpness - 1) / mean_;
      for (size_t s = 0; s < side->samples.size(); ++s) {
        const SamplePair& pair = side->pairs[s];
        const double spring = importance * side->shares[s] / (pair.distance + linear_ * mean);
        const double bound = kBound * max_;
        const double hinge = pair.distance > bound ? 2 * weight_ / (max_ * max_) : 0;
        const double pull = spring + (hinge > 0 ? hinge * (1 - bound / pair.distance) : 0);
        add_pair(pair, spring + hinge, pull);
      }
    }
  }

  void add_pair(const SamplePair& pair, double stiffness, double pull) {
    const Matrix3d q = stiffness * ((1 - kAlong) * pair.direction * pair.direction.transpose() +
                                    kAlong * Matrix3d::Identity());
    const Vector3d force = pull * (pair.target - pair.on_mesh.position);
    const SurfaceTopology::Triangle& corners = mesh_.triangles[pair.on_mesh.triangle];
    for (size_t a = 0; a < 3; ++a) {
      const double wa = pair.on_mesh.weights[static_cast<Index>(a)];
      if (wa == 0)
        continue;
      right_.row(static_cast<Index>(corners[a])) += wa * force.transpose();
      system_.add_diagonal(corners[a], wa * wa * q);
      for (size_t b = a + 1; b < 3; ++b) {
        const double wb = pair.on_mesh.weights[static_cast<Index>(b)];
        if (wb != 0)
          system_.add_edge(corners[a], corners[b], wa * wb * q);
      }
    }
  }

  /// A step that lowers the merit. Returns its root mean square length, 0 if none was found.
  double move() {
    const double value = merit().value(weight_);
    const Positions before = v_;
    const double count = std::max<double>(1, static_cast<double>(v_.rows()));
    shape_.update_rotations(v_, &rotations_);
    const Positions shape_force = -shape_.half_gradient(v_, rotations_);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      v_ = before + solve(shape_force, 1 / (count * mean_ * mean_));
      hold_turning(before);
      distance_.update(v_, true);
      if (merit().value(weight_) < value) {
        damping_ = std::max(kLeastDamping, damping_ * kLess);
        stiffness_ = std::max(kLeastStiffness, stiffness_ * kSofter);
        return (v_ - before).norm() / std::sqrt(count);
      }
      damping_ *= kMore;
      stiffness_ = std::max(kLeastStiffness, stiffness_ * kSofter);
    }
    v_ = before;
    distance_.update(v_, true);
    return 0;
  }

  /// Shortens the steps of vertices whose triangles turn by them, at last to nothing.
  void hold_turning(const Positions& before) const {
    if (!holds_)
      return;
    constexpr int kHalvings = 4;
    const std::vector<uint32_t> old = turned_triangles(mesh_, before, surface_);
    for (int k = 0; k < 2 * kHalvings; ++k) {
      std::vector<bool> held(mesh_.vertex_count, false);
      bool any = false;
      for (uint32_t t : turned_triangles(mesh_, v_, surface_)) {
        if (std::binary_search(old.begin(), old.end(), t))
          continue;
        any = true;
        for (uint32_t corner : mesh_.triangles[t])
          held[corner] = true;
      }
      if (!any)
        return;
      const double share = k < kHalvings ? 0.5 : 0;
      for (uint32_t i = 0; i < mesh_.vertex_count; ++i) {
        const auto r = static_cast<Index>(i);
        if (held[i])
          v_.row(r) = before.row(r) + share * (v_.row(r) - before.row(r));
      }
    }
  }

  Positions solve(const Positions& shape_force, double unit) const {
    BlockSystem system = system_;
    const double stiffness = stiffness_ * unit;
    for (uint32_t i = 0; i < mesh_.vertex_count; ++i) {
      const double total = stiffness * shape_.total_weight()[static_cast<Index>(i)];
      system.add_diagonal(i, (total + damping_ * unit) * Matrix3d::Identity());
      for (const RigidShape::Spoke& spoke : shape_.spokes(i)) {
        if (spoke.end > i)
          system.add_edge(i, spoke.end, -stiffness * spoke.weight * Matrix3d::Identity());
      }
    }
    return system.solve(right_ + stiffness * shape_force, kSolveTolerance, kMostIterations);
  }

  const SurfaceTopology& mesh_;
  const Surface& surface_;
  Positions& v_;
  RigidShape shape_;
  MutualDistance distance_;
  BlockSystem system_;  ///< of the samples alone
  Positions right_;
  std::vector<Matrix3d> rotations_;
  double mean_ = 0, max_ = 0, edge_ = 0;  ///< at the start
  double weight_ = kFirstWeight, linear_ = kFirstLinear;
  double damping_ = kFirstDamping, stiffness_ = kFirstStiffness;
  Positions best_;
  bool holds_ = true;
  size_t first_turned_ = 0, least_turned_ = 0;
  double least_score_ = 1;
};

}  // namespace

Convergence fit_closely(const SurfaceTopology& mesh, const Surface& surface, Positions* v) {
  return CloseFit(mesh, surface, v).run();
}

}  // namespace anicodec
