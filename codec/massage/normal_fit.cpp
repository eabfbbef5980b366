// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/normal_fit.h"

#include "codec/massage/correspondence.h"

#include <vector>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double kFromMesh = 0.5;       // weight of a distance, against those from the surface
constexpr double kRest = 0.05;          // weight of the height itself
constexpr double kFitTolerance = 1e-3;  // of the solver, relative

/// The equations of one round.
class HeightEquations {
 public:
  HeightEquations(const Surface& moving, const Surface& surface)
      : moving_(moving),
        topology_(moving.topology()),
        right_(Eigen::VectorXd::Zero(moving.positions().rows())) {
    entries_.reserve(size_t{11} * topology_.vertex_count + size_t{9} * topology_.triangles.size());
    for (uint32_t i = 0; i < topology_.vertex_count; ++i) {
      entries_.emplace_back(static_cast<int>(i), static_cast<int>(i), kRest);
      if (topology_.star[i].empty())
        continue;
      const uint32_t start = topology_.star[i][0];
      add({i, i, i}, Vector3d::UnitX(), surface, surface.walk(row(moving.positions(), i), start));
      const SurfacePoint under = moving.walk(row(surface.positions(), i), start);
      const Vector3d normal = row(surface.normals(), i);
      if (moving.normal(under).dot(normal) >= kLeastAgreement)
        add(topology_.triangles[under.triangle], under.weights, row(surface.positions(), i), normal,
            1);
    }
    for (uint32_t t = 0; t < topology_.triangles.size(); ++t) {
      const SurfaceTopology::Triangle& k = topology_.triangles[t];
      const Positions& v = moving.positions();
      add(k, Vector3d::Constant(1.0 / 3), surface,
          surface.walk((row(v, k[0]) + row(v, k[1]) + row(v, k[2])) / 3, t));
    }
  }

  Eigen::VectorXd solve() const {
    Matrix matrix(right_.size(), right_.size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(kFitTolerance);
    solver.compute(matrix);
    return solver.solve(right_);
  }

 private:
  void add(const SurfaceTopology::Triangle& corners, const Vector3d& weights,
           const Surface& surface, const SurfacePoint& closest) {
    const Vector3d normal = surface.normal(closest);
    if (moving_normal(corners).dot(normal) >= kLeastAgreement)
      add(corners, weights, surface.curved(closest), normal, kFromMesh);
  }

  Vector3d moving_normal(const SurfaceTopology::Triangle& corners) const {
    return (row(moving_.normals(), corners[0]) + row(moving_.normals(), corners[1]) +
            row(moving_.normals(), corners[2]))
        .normalized();
  }

  /// A point of the mesh is to reach a plane.
  void add(const SurfaceTopology::Triangle& corners, const Vector3d& weights,
           const Vector3d& target, const Vector3d& normal, double importance) {
    double off = target.dot(normal);
    Vector3d slope;
    for (size_t a = 0; a < 3; ++a) {
      const auto k = static_cast<Index>(a);
      off -= weights[k] * row(moving_.positions(), corners[a]).dot(normal);
      slope[k] = weights[k] * row(moving_.normals(), corners[a]).dot(normal);
    }
    for (size_t a = 0; a < 3; ++a) {
      const double sa = importance * slope[static_cast<Index>(a)];
      right_[static_cast<Index>(corners[a])] += sa * off;
      for (size_t b = 0; b < 3; ++b) {
        const double product = sa * slope[static_cast<Index>(b)];
        if (product != 0)
          entries_.emplace_back(static_cast<int>(corners[a]), static_cast<int>(corners[b]),
                                product);
      }
    }
  }

  const Surface& moving_;
  const SurfaceTopology& topology_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_;
};

}  // namespace

void fit_normals(const Surface& surface, int rounds, Positions* v) {
  const SurfaceTopology& topology = surface.topology();
  for (int round = 0; round < rounds; ++round) {
    const Surface moving(topology, *v);
    const Eigen::VectorXd heights = HeightEquations(moving, surface).solve();
    for (uint32_t i = 0; i < topology.vertex_count; ++i) {
      const auto r = static_cast<Index>(i);
      if (topology.kind[i] == VertexKind::kInner)
        v->row(r) += heights[r] * moving.normals().row(r);
    }
  }
}

}  // namespace anicodec
