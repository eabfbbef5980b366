// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/registration.h"

#include "codec/massage/fold_guard.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kMovesPerIndex = 2;  // the mesh moves far between them
constexpr int kMostPosingSteps = 300;
constexpr double kTolerance = 1e-2;  // of the step, in mean edges
constexpr int kPoseRounds = 20;
constexpr double kFirstPoseStiffness = 1, kLastPoseStiffness = 0.1;  // against the landmarks

/// The stiffness of a round, from first to last.
double stiffness_at(double first, double last, int round, int rounds) {
  const double t = rounds > 1 ? static_cast<double>(round) / (rounds - 1) : 1;
  return first * std::pow(last / first, t);
}

/// The weight of a distance in each direction: full across the surface, by a share along it. A
/// boundary vertex is free along the boundary only.
Matrix3d metric(const Correspondence& c, double along_share) {
  const Matrix3d all = Matrix3d::Identity();
  const Matrix3d across = c.along.squaredNorm() > 0 ? Matrix3d(all - c.along * c.along.transpose())
                                                    : Matrix3d(c.normal * c.normal.transpose());
  return across + along_share * (all - across);
}

}  // namespace

Registration::Registration(const SurfaceTopology& mesh, const RigidShape& shape)
    : mesh_(&mesh), shape_(&shape), system_(mesh) {}

void Registration::add_shape(double stiffness) {
  for (uint32_t i = 0; i < mesh_->vertex_count; ++i) {
    const double total = stiffness * shape_->total_weight()[static_cast<Index>(i)] + kDamping;
    system_.add_diagonal(i, total * Matrix3d::Identity());
    for (const RigidShape::Spoke& s : shape_->spokes(i)) {
      if (s.end > i)
        system_.add_edge(i, s.end, -stiffness * s.weight * Matrix3d::Identity());
    }
  }
}

void Registration::add_landmarks(const std::vector<Landmark>& landmarks, double weight,
                                 const Positions& v, Positions* right) {
  for (const Landmark& l : landmarks) {
    system_.add_diagonal(l.vertex, weight * Matrix3d::Identity());
    right->row(static_cast<Index>(l.vertex)) +=
        weight * (l.position - row(v, l.vertex)).transpose();
  }
}

void Registration::add_correspondences(const std::vector<Correspondence>& list, double along_share,
                                       const Positions& v, Positions* right) {
  double total = 0;
  for (const Correspondence& c : list)
    total += c.used ? c.importance : 0;
  if (!(total > 0))
    return;
  const double unit = static_cast<double>(mesh_->vertex_count) / total;
  for (const Correspondence& c : list) {
    if (!c.used)
      continue;
    const Matrix3d q = unit * c.importance * metric(c, along_share);
    const Vector3d pull = q * (c.target - c.point(v));
    for (size_t a = 0; a < 3; ++a) {
      const double wa = c.weights[static_cast<Index>(a)];
      if (wa == 0)
        continue;
      right->row(static_cast<Index>(c.corners[a])) += wa * pull.transpose();
      system_.add_diagonal(c.corners[a], wa * wa * q);
      for (size_t b = a + 1; b < 3; ++b) {
        const double wb = c.weights[static_cast<Index>(b)];
        if (wb != 0)
          system_.add_edge(c.corners[a], c.corners[b], wa * wb * q);
      }
    }
  }
}

RegistrationReport Registration::run(const Surface& surface, const RegistrationOptions& options,
                                     Positions* v) {
  RegistrationReport report;
  std::vector<Matrix3d> rotations(mesh_->vertex_count, Matrix3d::Identity());
  Correspondences correspondences(*mesh_, surface, options.centres);
  const double edge = mean_edge(*mesh_, *v);
  const auto count = static_cast<double>(std::max<Index>(1, v->rows()));
  Convergence& c = report.convergence;
  for (int round = 0; round < options.rounds; ++round) {
    const double stiffness =
        stiffness_at(options.first_stiffness, options.last_stiffness, round, options.rounds);
    correspondences.update(*v, round % kMovesPerIndex == 0);
    if (options.trust_near)
      correspondences.trust_near(*v);
    shape_->update_rotations(*v, &rotations);
    // Solved for the step from where the mesh is.
    system_.clear();
    add_shape(stiffness);
    Positions right = -stiffness * shape_->half_gradient(*v, rotations);
    const double along = options.point_share * stiffness / (stiffness + 1);
    add_correspondences(correspondences.from_mesh(), along, *v, &right);
    add_correspondences(correspondences.from_surface(), along, *v, &right);
    add_landmarks(options.landmarks, options.landmark_weight, *v, &right);
    const Positions old = *v;
    fold_guarded_step(
        *mesh_, old, system_.solve(right, kSolveTolerance, kMostPosingSteps),
        [v](uint32_t i, const Vector3d& q) { v->row(static_cast<Index>(i)) = q.transpose(); },
        [&](uint32_t t) { return correspondences.facing(t); }, *v);
    const double step = (*v - old).norm() / std::sqrt(count);
    c.step = edge > 0 ? step / edge : 0;
    ++c.rounds;
  }
  c.converged = c.step < kTolerance;
  correspondences.update(*v, true);
  report.residuals = correspondences.residuals(*v);
  return report;
}

void Registration::pose(const std::vector<Landmark>& landmarks, Positions* v) {
  std::vector<Matrix3d> rotations(mesh_->vertex_count, Matrix3d::Identity());
  for (int round = 0; round < kPoseRounds; ++round) {
    const double stiffness =
        stiffness_at(kFirstPoseStiffness, kLastPoseStiffness, round, kPoseRounds);
    shape_->update_rotations(*v, &rotations);
    system_.clear();
    add_shape(stiffness);
    Positions right = -stiffness * shape_->half_gradient(*v, rotations);
    add_landmarks(landmarks, 1, *v, &right);
    *v += system_.solve(right, kSolveTolerance, kMostPosingSteps);
  }
}

}  // namespace anicodec
