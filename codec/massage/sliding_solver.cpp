// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/sliding_solver.h"

#include "codec/massage/fold_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTangentDamping = 1e-3;  // of the diagonal
// Relative to the right side. The rest is smooth: it hardly matters for shapes, costs most iterations,
// and would carry vertices far along the surface.
constexpr double kSlideTolerance = 0.1;
constexpr int kMostConjugateSteps = 300;
const double kCornerCosine = -std::cos(std::acos(-1.0) / 6);

/// The place of a vertex on the surface, and the directions in which it may move.
struct Place {
  uint32_t triangle;  ///< or the vertex of the boundary, for boundary vertices
  Vector3d normal = Vector3d::Zero();
  Vector3d tangent[2] = {Vector3d::Zero(), Vector3d::Zero()};

  /// The part of a vector that the vertex may move along.
  Vector3d along(const Vector3d& x) const {
    return tangent[0] * tangent[0].dot(x) + tangent[1] * tangent[1].dot(x);
  }
};

void set_tangents(Place* place) {
  const Vector3d& n = place->normal;
  if (!(n.squaredNorm() > 0)) {
    place->tangent[0] = place->tangent[1] = Vector3d::Zero();
    return;
  }
  const Vector3d axis = std::abs(n[0]) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
  place->tangent[0] = n.cross(axis).normalized();
  place->tangent[1] = n.cross(place->tangent[0]);
}

/// One frame being slid.
class SlidingFrame {
 public:
  SlidingFrame(const SurfaceTopology& topology, const RigidShape& shape,
               const std::vector<uint8_t>& freedom, const Surface& surface, Positions* v)
      : topology_(topology),
        shape_(shape),
        freedom_(freedom),
        surface_(surface),
        v_(*v),
        places_(topology.vertex_count),
        rotations_(topology.vertex_count, Matrix3d::Identity()),
        size_(ring_sizes(topology, v_)) {
    for (uint32_t i = 0; i < topology_.vertex_count; ++i) {
      if (freedom_[i] == 2)
        places_[i].triangle = topology_.star[i][0];
      else
        places_[i].triangle = i;
      place_vertex(i, row(v_, i));
    }
  }

  double round(double longest_step) {
    shape_.update_rotations(v_, &rotations_);
    Positions step = solve();
    const Positions old = v_;
    for (uint32_t i = 0; i < topology_.vertex_count; ++i) {
      const double length = row(step, i).norm(), most = longest_step * size_[i];
      if (length > most)
        step.row(static_cast<Index>(i)) *= most / length;
    }
    fold_guarded_step(
        topology_, old, std::move(step),
        [this](uint32_t i, const Vector3d& q) { place_vertex(i, q); },
        [this](uint32_t t) -> Vector3d {
          const SurfaceTopology::Triangle& corner = topology_.triangles[t];
          return places_[corner[0]].normal + places_[corner[1]].normal + places_[corner[2]].normal;
        },
        v_);
    return (v_ - old).norm() / std::sqrt(static_cast<double>(std::max<Index>(1, v_.rows())));
  }

 private:
  /// Places vertex i on the surface near q.
  void place_vertex(uint32_t i, const Vector3d& q) {
    Place& place = places_[i];
    Vector3d to = q;
    if (freedom_[i] == 2) {
      const SurfacePoint point = surface_.walk(q, place.triangle);
      place.triangle = point.triangle;
      place.normal = surface_.normal(point);
      set_tangents(&place);
      to = surface_.curved(point);
    } else if (freedom_[i] == 1) {
      to = surface_.walk_boundary(q, &place.triangle, &place.tangent[0]).position;
    }
    v_.row(static_cast<Index>(i)) = to.transpose();
  }

  void restrict_to_tangents(Positions* x) const {
    for (uint32_t i = 0; i < topology_.vertex_count; ++i)
      x->row(static_cast<Index>(i)) = places_[i].along(row(*x, i)).transpose();
  }

  /// The moves in the tangent planes that minimise the rigid energy with the present rotations, by
  /// conjugate gradients with a diagonal preconditioner.
  Positions solve() const {
    const Index count = v_.rows();
    Eigen::VectorXd diagonal = (1 + kTangentDamping) * shape_.total_weight();
    diagonal = (diagonal.array() > 0).select(diagonal, 1.0);
    Positions residual = -shape_.half_gradient(v_, rotations_);
    restrict_to_tangents(&residual);
    Positions u = Positions::Zero(count, 3), image(count, 3);
    Positions scaled = diagonal.cwiseInverse().asDiagonal() * residual;
    Positions direction = scaled;
    double product = residual.cwiseProduct(scaled).sum();
    const double goal = product * kSlideTolerance * kSlideTolerance;
    for (int k = 0; k < kMostConjugateSteps && product > goal && product > 0; ++k) {
      shape_.apply_laplacian(direction, &image);
      image += kTangentDamping * (shape_.total_weight().asDiagonal() * direction);
      restrict_to_tangents(&image);
      const double curvature = direction.cwiseProduct(image).sum();
      if (!(curvature > 0))
        break;
      const double factor = product / curvature;
      u += factor * direction;
      residual -= factor * image;
      scaled = diagonal.cwiseInverse().asDiagonal() * residual;
      const double next = residual.cwiseProduct(scaled).sum();
      direction = scaled + (next / product) * direction;
      product = next;
    }
    return u;
  }

  const SurfaceTopology& topology_;
  const RigidShape& shape_;
  const std::vector<uint8_t>& freedom_;
  const Surface& surface_;
  Positions& v_;
  std::vector<Place> places_;
  std::vector<Matrix3d> rotations_;
  Eigen::VectorXd size_;
};

}  // namespace

std::vector<uint8_t> sliding_freedom(const SurfaceTopology& topology, const Positions& reference) {
  std::vector<uint8_t> freedom(topology.vertex_count, 0);
  for (uint32_t i = 0; i < topology.vertex_count; ++i) {
    if (topology.kind[i] == VertexKind::kInner) {
      freedom[i] = 2;
    } else if (topology.kind[i] == VertexKind::kBoundary) {
      const auto [a, b] = topology.boundary_neighbours[i];
      const Vector3d x = (row(reference, a) - row(reference, i)).normalized();
      const Vector3d y = (row(reference, b) - row(reference, i)).normalized();
      freedom[i] = x.dot(y) > kCornerCosine ? 0 : 1;
    }
  }
  return freedom;
}

SlidingSolver::SlidingSolver(const SurfaceTopology& topology, const Positions& reference)
    : topology_(&topology),
      shape_(topology, reference),
      freedom_(sliding_freedom(topology, reference)) {}

Convergence SlidingSolver::run(const Surface& surface, const SlidingOptions& options,
                               Positions* v) const {
  SlidingFrame slide(*topology_, shape_, freedom_, surface, v);
  const double edge = mean_edge(*topology_, surface.positions());
  Convergence result;
  while (result.rounds < options.rounds && !result.converged) {
    const double step = slide.round(options.longest_step);
    result.step = edge > 0 ? step / edge : 0;
    ++result.rounds;
    result.converged = result.step < options.tolerance;
  }
  return result;
}

}  // namespace anicodec
