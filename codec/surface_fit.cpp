// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface_fit.h"

#include "codec/error.h"
#include "codec/turn_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double kLeastAgreement = 0.3;   // of unit normals
constexpr int kIndexEvery = 4;            // rounds
constexpr double kHold = 1e3;             // weight of a held vertex, in those of other rows
constexpr Index kLargestDirect = 30000;   // vertices
constexpr double kLeastIterative = 0.5;   // lambda from which few iterations do
constexpr double kSolveTolerance = 1e-4;  // of the right side
constexpr double kLeastLawson = 1e-2, kMostLawson = 1e3;

/// A row of B: a point of a triangle of the mesh, or a vertex, and where it is to be.
struct DistanceRow {
  SurfaceTopology::Triangle corners{};
  Vector3d weights = Vector3d::UnitX();
  Vector3d target = Vector3d::Zero();
  bool used = false;
  double importance = 1;  ///< Lawson's weight

  Vector3d point(const Positions& v) const {
    return weights[0] * row(v, corners[0]) + weights[1] * row(v, corners[1]) +
           weights[2] * row(v, corners[2]);
  }
};

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
class SurfaceFitter::Solver {
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
    iterative.setTolerance(kSolveTolerance);
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
class SurfaceFitter::Run {
 public:
  Run(SurfaceFitter& fitter, const Surface& surface, const SurfaceFitOptions& options, Positions* v)
      : fitter_(fitter),
        mesh_(*fitter.mesh_),
        target_(surface),
        options_(options),
        v_(*v),
        to_surface_(mesh_.vertex_count + (options.centres ? mesh_.triangles.size() : 0)),
        to_mesh_(surface.topology().vertex_count),
        from_mesh_(to_surface_.size(), SurfaceTopology::kNone),
        from_surface_(to_mesh_.size(), SurfaceTopology::kNone),
        up_(Positions::Zero(v->rows(), 3)),
        matrix_(fitter.square_) {}

  SurfaceFitReport run() {
    SurfaceFitReport report;
    const double edge = mean_edge(mesh_, v_);
    const auto count = static_cast<double>(std::max<Index>(1, v_.rows()));
    double best_max = std::numeric_limits<double>::infinity();
    Positions best = v_;
    Convergence& c = report.convergence;
    while (c.rounds < options_.rounds && !c.converged) {
      update_rows(c.rounds % kIndexEvery == 0);
      measure(&report);
      if (options_.lawson > 0 && report.max < best_max) {
        best_max = report.max;
        best = v_;
      }
      const Positions old = v_;
      guarded_step(
          mesh_, old, solve(),
          [this](uint32_t i, const Vector3d& q) { v_.row(static_cast<Index>(i)) = q.transpose(); },
          [this](uint32_t t) -> Vector3d {
            const SurfaceTopology::Triangle& k = mesh_.triangles[t];
            return row(up_, k[0]) + row(up_, k[1]) + row(up_, k[2]);
          },
          v_);
      const double step = (v_ - old).norm() / std::sqrt(count);
      c.step = edge > 0 ? step / edge : 0;
      ++c.rounds;
      c.converged = c.step < options_.tolerance;
    }
    if (options_.lawson > 0) {
      update_rows(true);
      measure(&report);
      if (best_max < report.max) {
        v_ = best;
        report.max = best_max;
      }
    }
    return report;
  }

 private:
  /// Finds the closest points both ways.
  void update_rows(bool by_index) {
    const Positions normals = vertex_normals(mesh_, v_);
    tbb::parallel_for(size_t{0}, to_surface_.size(), [&](size_t r) {
      if (r < mesh_.vertex_count)
        draw_vertex(static_cast<uint32_t>(r), normals, by_index);
      else
        draw_centre(static_cast<uint32_t>(r - mesh_.vertex_count), r, by_index);
    });
    Surface mine(mesh_, v_);
    if (by_index)
      mine.build_index();
    tbb::parallel_for(size_t{0}, to_mesh_.size(), [&](size_t j) {
      if (!target_.topology().star[j].empty())
        draw_to_vertex(static_cast<uint32_t>(j), mine, by_index);
    });
  }

  SurfacePoint find(const Surface& surface, const Vector3d& q, bool by_index,
                    uint32_t* start) const {
    const SurfacePoint point =
        by_index || *start == SurfaceTopology::kNone ? surface.closest(q) : surface.walk(q, *start);
    *start = point.triangle;
    return point;
  }

  void draw_vertex(uint32_t i, const Positions& normals, bool by_index) {
    DistanceRow& r = to_surface_[i];
    r.corners = {i, i, i};
    if (mesh_.star[i].empty()) {
      r.used = false;
      return;
    }
    const Vector3d here = row(v_, i);
    const SurfacePoint point = find(target_, here, by_index, &from_mesh_[i]);
    const Vector3d normal = target_.normal(point);
    up_.row(static_cast<Index>(i)) = normal.transpose();
    r.target = point.position;
    if (mesh_.kind[i] == VertexKind::kBoundary && target_.topology().has_boundary()) {
      r.target = target_.closest_on_boundary(here);
      r.used = true;
      return;
    }
    r.used = row(normals, i).dot(normal) >= kLeastAgreement &&
             !(mesh_.kind[i] == VertexKind::kInner && target_.on_boundary(point));
  }

  void draw_centre(uint32_t t, size_t r, bool by_index) {
    const SurfaceTopology::Triangle& corner = mesh_.triangles[t];
    to_surface_[r].corners = corner;
    to_surface_[r].weights = Vector3d::Constant(1.0 / 3);
    const SurfacePoint point = find(target_, to_surface_[r].point(v_), by_index, &from_mesh_[r]);
    to_surface_[r].target = point.position;
    const Vector3d normal = area_normal(v_, corner).normalized();
    to_surface_[r].used =
        normal.dot(target_.normal(point)) >= kLeastAgreement && !target_.on_boundary(point);
  }

  void draw_to_vertex(uint32_t j, const Surface& mine, bool by_index) {
    DistanceRow& r = to_mesh_[j];
    const Vector3d there = row(target_.positions(), j);
    const SurfacePoint point = find(mine, there, by_index, &from_surface_[j]);
    r.corners = mesh_.triangles[point.triangle];
    r.weights = point.weights;
    r.target = there;
    r.used = mine.normal(point).dot(row(target_.normals(), j)) >= kLeastAgreement &&
             (target_.topology().kind[j] != VertexKind::kInner || !mine.on_boundary(point));
  }

  void measure(SurfaceFitReport* report) {
    double squares = 0, largest = 0;
    size_t used = 0, rows = 0;
    auto each = [&](auto&& visit) {
      for (auto* list : {&to_surface_, &to_mesh_}) {
        for (DistanceRow& r : *list)
          visit(r);
      }
    };
    each([&](DistanceRow& r) {
      ++rows;
      if (!r.used)
        return;
      const double square = (r.point(v_) - r.target).squaredNorm();
      squares += square;
      largest = std::max(largest, square);
      ++used;
    });
    report->max = std::sqrt(largest);
    report->rms = used > 0 ? std::sqrt(squares / static_cast<double>(used)) : 0;
    report->dropped_share =
        rows > 0 ? 1 - static_cast<double>(used) / static_cast<double>(rows) : 0;
    if (!(options_.lawson > 0) || !(report->rms > 0))
      return;
    double sum = 0;
    each([&](DistanceRow& r) {
      if (!r.used)
        return;
      const double distance = (r.point(v_) - r.target).norm();
      r.importance *= std::pow(distance / report->rms + 1e-3, options_.lawson);
      sum += r.importance;
    });
    each([&](DistanceRow& r) {
      r.importance =
          std::clamp(r.importance * static_cast<double>(used) / sum, kLeastLawson, kMostLawson);
    });
  }

  void add_rows(const std::vector<DistanceRow>& rows, Positions* right) {
    const auto used =
        std::count_if(rows.begin(), rows.end(), [](const DistanceRow& r) { return r.used; });
    const double share = options_.lambda / static_cast<double>(std::max<ptrdiff_t>(1, used));
    for (const DistanceRow& r : rows) {
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
    add_rows(to_surface_, &right);
    add_rows(to_mesh_, &right);
    // What nothing else holds stays where it is.
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

  SurfaceFitter& fitter_;
  const SurfaceTopology& mesh_;
  const Surface& target_;
  const SurfaceFitOptions& options_;
  Positions& v_;
  std::vector<DistanceRow> to_surface_, to_mesh_;
  std::vector<uint32_t> from_mesh_, from_surface_;  ///< where each row's walk starts
  Positions up_;                                    ///< normals of the surface at the vertices
  Matrix matrix_;
};

SurfaceFitter::SurfaceFitter(const SurfaceTopology& mesh, const RowMatrix& shape)
    : mesh_(&mesh),
      shape_(&shape),
      square_(square_with_edges(mesh, shape)),
      solver_(std::make_unique<Solver>()) {}

SurfaceFitter::~SurfaceFitter() = default;

SurfaceFitReport SurfaceFitter::run(const Surface& surface, const SurfaceFitOptions& options,
                                    Positions* v) {
  return Run(*this, surface, options, v).run();
}

}  // namespace anicodec
