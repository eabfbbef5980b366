// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/shape_fit.h"

#include "codec/massage/correspondence.h"
#include "codec/massage/fold_guard.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Matrix = Eigen::SparseMatrix<double>;

constexpr int kIndexEvery = 4;            // rounds
constexpr double kHold = 1e3;             // weight of a held vertex, in those of other rows
constexpr Index kLargestDirect = 30000;   // vertices
constexpr double kLeastIterative = 0.5;   // lambda from which few iterations do
constexpr double kShapeTolerance = 1e-4;  // of the right side

/// The pattern that the system has at all times: A^T A, the diagonal and all edges.
Matrix square_with_edges(const SurfaceTopology& mesh, const RowMatrix& shape) {
  Matrix pattern(shape.cols(), shape.cols());
  std::vector<Eigen::Triplet<double>> zeros;
  for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
    zeros.emplace_back(static_cast<Index>(i), static_cast<Index>(i), 0.0);
    for (uint32_t j : mesh.ring[i])
      zeros.emplace_back(static_cast<Index>(i), static_cast<Index>(j), 0.0);
  }
  pattern.setFromTriplets(zeros.begin(), zeros.end());
  const Matrix columns = shape;
  Matrix square = Matrix(columns.transpose() * columns) + pattern;
  square.makeCompressed();
  return square;
}

void add_to(Matrix* matrix, Index r, Index c, double value) {
  const int* first = matrix->innerIndexPtr() + matrix->outerIndexPtr()[c];
  const int* last = matrix->innerIndexPtr() + matrix->outerIndexPtr()[c + 1];
  const int* place = std::lower_bound(first, last, static_cast<int>(r));
  matrix->valuePtr()[place - matrix->innerIndexPtr()] += value;
}

}  // namespace

/// Solves systems of one pattern.
class ShapeFit::Solver {
 public:
  Positions solve(const Matrix& matrix, const Positions& right, double lambda) {
    if (matrix.rows() < kLargestDirect && lambda < kLeastIterative) {
      if (!analysed_)
        direct_.analyzePattern(matrix);
      analysed_ = true;
      direct_.factorize(matrix);
      if (direct_.info() == Eigen::Success)
        return direct_.solve(Eigen::MatrixXd(right));
    }
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> iterative;
    iterative.setTolerance(kShapeTolerance);
    iterative.setMaxIterations(1000);
    iterative.compute(matrix);
    Positions result = iterative.solve(Eigen::MatrixXd(right));
    if (!result.allFinite())
      throw Error(ErrorKind::kInput, "the mesh cannot be massaged: its equations are singular");
    return result;
  }

 private:
  Eigen::SimplicialLDLT<Matrix> direct_;
  bool analysed_ = false;
};

/// The state of one run.
class ShapeFit::FitIteration {
 public:
  FitIteration(ShapeFit& fitter, const Surface& surface, const ShapeFitOptions& options,
               Positions* v)
      : fitter_(fitter),
        mesh_(*fitter.mesh_),
        options_(options),
        v_(*v),
        correspondences_(mesh_, surface, options.centres),
        matrix_(fitter.square_) {}

  ShapeFitReport run() {
    ShapeFitReport report;
    const double edge = mean_edge(mesh_, v_);
    const auto count = static_cast<double>(std::max<Index>(1, v_.rows()));
    const bool lawson = options_.lawson > 0;
    double best_max = std::numeric_limits<double>::infinity();
    Positions best = v_;
    Convergence& c = report.convergence;
    while (c.rounds < options_.rounds && !c.converged) {
      correspondences_.update(v_, c.rounds % kIndexEvery == 0);
      report.residuals = correspondences_.residuals(v_);
      if (lawson && report.residuals.max < best_max) {
        best_max = report.residuals.max;
        best = v_;
      }
      if (lawson)
        correspondences_.reweight(v_, options_.lawson);
      const Positions old = v_;
      fold_guarded_step(
          mesh_, old, solve(),
          [this](uint32_t i, const Vector3d& q) { v_.row(static_cast<Index>(i)) = q.transpose(); },
          [this](uint32_t t) { return correspondences_.facing(t); }, v_);
      const double step = (v_ - old).norm() / std::sqrt(count);
      c.step = edge > 0 ? step / edge : 0;
      ++c.rounds;
      c.converged = c.step < options_.tolerance;
    }
    if (lawson) {
      correspondences_.update(v_, true);
      report.residuals = correspondences_.residuals(v_);
      if (best_max < report.residuals.max) {
        v_ = best;
        report.residuals.max = best_max;
      }
    }
    return report;
  }

 private:
  void add_rows(const std::vector<Correspondence>& rows, Positions* right) {
    const auto used =
        std::count_if(rows.begin(), rows.end(), [](const Correspondence& r) { return r.used; });
    const double share = options_.lambda / static_cast<double>(std::max<ptrdiff_t>(1, used));
    for (const Correspondence& r : rows) {
      if (!r.used)
        continue;
      const double weight = share * r.importance;
      for (size_t a = 0; a < 3; ++a) {
        const double wa = r.weights[static_cast<Index>(a)];
        if (wa == 0)
          continue;
        const auto ia = static_cast<Index>(r.corners[a]);
        right->row(ia) += weight * wa * r.target.transpose();
        for (size_t b = 0; b < 3; ++b) {
          const double wb = r.weights[static_cast<Index>(b)];
          if (wb != 0)
            add_to(&matrix_, ia, static_cast<Index>(r.corners[b]), weight * wa * wb);
        }
      }
    }
  }

  /// The step to the minimum with the present rows.
  Positions solve() {
    const RowMatrix& shape = *fitter_.shape_;
    const double share = (1 - options_.lambda) / static_cast<double>(mesh_.vertex_count);
    const Positions normals = vertex_normals(mesh_, v_);
    Positions delta = shape * v_;
    for (uint32_t i = 0; i < mesh_.vertex_count; ++i) {
      const Vector3d n = row(normals, i);
      const auto r = static_cast<Index>(i);
      delta.row(r) = mesh_.kind[i] == VertexKind::kInner
                         ? (n * n.dot(row(delta, i))).transpose().eval()
                         : Eigen::RowVector3d::Zero().eval();
    }
    Positions right = share * (shape.transpose() * delta);
    Eigen::Map<Eigen::VectorXd>(matrix_.valuePtr(), matrix_.nonZeros()) =
        share *
        Eigen::Map<const Eigen::VectorXd>(fitter_.square_.valuePtr(), fitter_.square_.nonZeros());
    add_rows(correspondences_.from_mesh(), &right);
    add_rows(correspondences_.from_surface(), &right);
    // A vertex that nothing else holds stays in its place.
    const double hold = kHold / static_cast<double>(mesh_.vertex_count);
    for (uint32_t i = 0; i < mesh_.vertex_count; ++i) {
      const auto r = static_cast<Index>(i);
      const bool free = shape.outerIndexPtr()[r + 1] > shape.outerIndexPtr()[r];
      const double weight = free ? 1e-9 * hold : hold;
      add_to(&matrix_, r, r, weight);
      right.row(r) += weight * v_.row(r);
    }
    right -= matrix_ * v_;
    return fitter_.solver_->solve(matrix_, right, options_.lambda);
  }

  ShapeFit& fitter_;
  const SurfaceTopology& mesh_;
  const ShapeFitOptions& options_;
  Positions& v_;
  Correspondences correspondences_;
  Matrix matrix_;
};

ShapeFit::ShapeFit(const SurfaceTopology& mesh, const RowMatrix& shape)
    : mesh_(&mesh),
      shape_(&shape),
      square_(square_with_edges(mesh, shape)),
      solver_(std::make_unique<Solver>()) {}

ShapeFit::~ShapeFit() = default;

ShapeFitReport ShapeFit::run(const Surface& surface, const ShapeFitOptions& options, Positions* v) {
  return FitIteration(*this, surface, options, v).run();
}

}  // namespace anicodec
