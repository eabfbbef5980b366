// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/cross_parametrisation.h"

#include "codec/algebra/rigid_motion.h"
#include "codec/massage/shape_fit.h"
#include "codec/massage/shape_weights.h"
#include "codec/sequence/error.h"
#include "codec/surface/surface_match.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

void check_fits(const SurfaceTopology& mesh, const Positions& shape, const Surface& surface,
                const std::vector<Landmark>& landmarks) {
  check_openings(mesh, shape, surface);
  for (const Landmark& l : landmarks) {
    if (l.vertex >= mesh.vertex_count)
      throw Error(ErrorKind::kUsage, "landmark at vertex " + std::to_string(l.vertex) + " of " +
                                         std::to_string(mesh.vertex_count));
  }
}

/// The shape matrix with empty rows for landmarks: the fit holds such vertices.
RowMatrix held_at(const RowMatrix& shape, const std::vector<Landmark>& landmarks) {
  std::vector<bool> held(static_cast<size_t>(shape.rows()), false);
  for (const Landmark& l : landmarks)
    held[l.vertex] = true;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < shape.rows(); ++i) {
    for (RowMatrix::InnerIterator it(shape, i); it && !held[static_cast<size_t>(i)]; ++it)
      entries.emplace_back(i, it.col(), it.value());
  }
  RowMatrix result(shape.rows(), shape.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Whether points, given relative to their mean, lie on a line.
bool on_a_line(const std::vector<Vector3d>& points) {
  Vector3d farthest = Vector3d::Zero();
  double size = 0;
  for (const Vector3d& p : points) {
    size += p.squaredNorm();
    if (p.squaredNorm() > farthest.squaredNorm())
      farthest = p;
  }
  const double limit = 1e-6 * std::sqrt(size);
  return std::all_of(points.begin(), points.end(), [&](const Vector3d& p) {
    return p.cross(farthest).norm() <= limit * farthest.norm();
  });
}

/// The shape turned, scaled and moved so that its landmarks come as near to their places as they
/// can (Umeyama, "Least-squares estimation of transformation parameters between two point
/// patterns", PAMI 1991).
Positions laid_on(const std::vector<Landmark>& landmarks, const Positions& shape) {
  if (landmarks.size() < 3)
    throw Error(ErrorKind::kUsage, "a map needs three landmarks at least");
  Vector3d from_mean = Vector3d::Zero(), to_mean = Vector3d::Zero();
  for (const Landmark& l : landmarks) {
    from_mean += row(shape, l.vertex) / static_cast<double>(landmarks.size());
    to_mean += l.position / static_cast<double>(landmarks.size());
  }
  std::vector<Vector3d> from;
  double size = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Landmark& l : landmarks) {
    from.emplace_back(row(shape, l.vertex) - from_mean);
    size += from.back().squaredNorm();
    covariance += (l.position - to_mean) * from.back().transpose();
  }
  if (on_a_line(from))
    throw Error(ErrorKind::kUsage, "the landmarks of a map must not lie on a line");
  const Eigen::Matrix3d rotation = best_rotation(covariance);
  const double scale = (rotation.transpose() * covariance).trace() / size;
  Positions laid = (shape.rowwise() - from_mean.transpose()) * (scale * rotation.transpose());
  laid.rowwise() += to_mean.transpose();
  return laid;
}

}  // namespace

CrossParametrisation improve_map(const SurfaceTopology& mesh, const Positions& shape,
                                 const Surface& surface, const Positions& rough,
                                 const CrossParametrisationOptions& options) {
  check_fits(mesh, shape, surface, options.landmarks);
  CrossParametrisation result;
  auto project = [&] {
    result.points.resize(mesh.vertex_count);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
      result.points[i] = surface.closest(row(result.positions, i));
      result.positions.row(static_cast<Index>(i)) = result.points[i].position.transpose();
    }
  };
  result.positions = rough;
  for (const Landmark& l : options.landmarks)
    result.positions.row(static_cast<Index>(l.vertex)) = l.position.transpose();
  project();
  result.before = distortion(mesh, shape, result.positions);
  const RowMatrix weights =
      held_at(shape_matrix(mesh, shape, ShapeWeights::kMeanValue), options.landmarks);
  ShapeFitOptions fit;
  fit.lambda = options.lambda;
  fit.rounds = options.rounds;
  fit.tolerance = options.tolerance;
  result.convergence = ShapeFit(mesh, weights).run(surface, fit, &result.positions).convergence;
  project();
  result.after = distortion(mesh, shape, result.positions);
  result.turned = static_cast<uint32_t>(turned_triangles(mesh, result.positions, surface).size());
  return result;
}

Positions map_by_landmarks(const SurfaceTopology& mesh, const Positions& shape,
                           const Surface& surface, const std::vector<Landmark>& landmarks) {
  check_fits(mesh, shape, surface, landmarks);
  const Positions laid = landmarks.empty() ? shape : laid_on(landmarks, shape);
  const RigidShape rigid(mesh, laid);
  RegistrationOptions options;
  options.first_stiffness = 20;
  options.rounds = 30;
  options.landmarks = landmarks;
  Positions v = laid;
  Registration(mesh, rigid).run(surface, options, &v);
  return v;
}

}  // namespace anicodec
