// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/motion/vertex_products.h"

#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/trajectory_gram.h"
#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-14;  // of all energy: what is below is no component

/// The square root of I - S S^T: takes out of functions what S spans. By a sketch, S is a little shorter than
/// orthonormal.
class Complement {
 public:
  explicit Complement(const MatrixXd& span) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(span.transpose() * span);
    const VectorXd& squares = solver.eigenvalues();
    Index first = 0;
    while (first < squares.size() && !(squares[first] > 1e-12))
      ++first;
    const Index count = squares.size() - first;
    axes_ = span * solver.eigenvectors().rightCols(count) *
            squares.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
    change_ = (1 - squares.tail(count).array()).max(0).sqrt() - 1;
  }

  void apply(Eigen::Ref<MatrixXd> functions) const {
    functions += axes_ * (change_.asDiagonal() * (axes_.transpose() * functions));
  }

  /// On both sides of a symmetric matrix.
  void apply_twice(Eigen::Ref<MatrixXd> symmetric) const {
    apply(symmetric);
    symmetric.transposeInPlace();
    apply(symmetric);
  }

 private:
  MatrixXd axes_;
  VectorXd change_;
};

/// One of the three functions that are the coordinates of a field, 3 vertices x any.
auto axis_of(Index axis, Index rows) {
  return Eigen::seqN(axis, rows / 3, Eigen::fix<3>);
}

Eigenpairs pairs_of(const MatrixXd& products, Index most, double smallest, double energy) {
  return leading_eigenpairs(products, most, std::max(smallest, kRounding * energy));
}

/// Projections on vectors of the energies' roots, made unit vectors.
MatrixXd normalised(const MatrixXd& projections, const VectorXd& energies) {
  return projections * energies.cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace

VertexProducts::VertexProducts(const FrameView& clip, const Eigen::Vector3d& origin, VectorXd ones,
                               size_t real_vertices)
    : clip_(clip),
      origin_(origin),
      ones_(std::move(ones)),
      real_vertices_(static_cast<double>(real_vertices)),
      gram_(vertex_gram_of_axes(clip, origin)) {}

const MatrixXd& VertexProducts::shape_gram() const {
  const std::scoped_lock lock(mutex_);
  // Isolated: a thread that waits for others in it must not take a task that waits for the lock.
  if (shape_gram_.size() == 0)
    isolated([&] { shape_gram_ = vertex_gram(clip_, origin_); });
  return shape_gram_;
}

size_t VertexProducts::best_frame() const {
  constexpr size_t kMostTried = 400;
  const size_t step = (clip_.frame_count + kMostTried - 1) / kMostTried;
  const size_t count = (clip_.frame_count + step - 1) / step;
  const auto n = static_cast<Index>(clip_.vertex_count);
  std::vector<double> explained(count, 0);
  parallel_for(size_t{0}, count, [&](size_t i) {
    const float* p = clip_.frame(i * step);
    MatrixXd functions(n, 3);
    for (Index v = 0; v < n; ++v, p += 3)
      for (Index c = 0; c < 3; ++c)
        functions(v, c) = double{p[c]} - origin_[c];
    const MatrixXd centred = functions - ones_ * (ones_.transpose() * functions) / real_vertices_;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        Eigen::Matrix3d(functions.transpose() * centred));
    for (Index a = 0; a < 3; ++a) {
      const double size = solver.eigenvalues()[a];
      if (size > 1e-9 * solver.eigenvalues()[2]) {
        const VectorXd axis = centred * solver.eigenvectors().col(a);
        explained[i] += axis.dot(gram_ * axis) / size;
      }
    }
  });
  return step * static_cast<size_t>(std::ranges::max_element(explained) - explained.begin());
}

MatrixXd VertexProducts::leading_trajectories(Index count) const {
  return trajectories(ones_ / std::sqrt(real_vertices_), count, 0).time;
}

VectorXd VertexProducts::frame_energies(Index most) const {
  return pairs_of(shape_gram(), most, 0, energy()).values;
}

TimeComponents VertexProducts::beyond_span(BasisKind kind, const MatrixXd& span, Index most,
                                           double smallest) const {
  return kind == BasisKind::kEigenshapes ? shapes(span, most, smallest)
                                         : trajectories(span, most, smallest);
}

TimeComponents VertexProducts::trajectories(const MatrixXd& span, Index most,
                                            double smallest) const {
  const Complement complement(span);
  MatrixXd products = gram_;
  complement.apply_twice(products);
  Eigenpairs pairs = pairs_of(products, most, smallest, energy());
  complement.apply(pairs.vectors);
  return {std::max(0.0, products.trace()), pairs.values,
          normalised(project_on_functions(clip_, origin_, pairs.vectors), pairs.values)};
}

TimeComponents VertexProducts::shapes(const MatrixXd& span, Index most, double smallest) const {
  const Complement complement(span);
  MatrixXd products = shape_gram();
  const auto apply = [&](MatrixXd& fields) {
    for (Index c = 0; c < 3; ++c) {
      MatrixXd of_axis = fields(axis_of(c, fields.rows()), Eigen::all);
      complement.apply(of_axis);
      fields(axis_of(c, fields.rows()), Eigen::all) = of_axis;
    }
  };
  apply(products);
  products.transposeInPlace();
  apply(products);
  Eigenpairs pairs = pairs_of(products, most, smallest, energy());
  apply(pairs.vectors);
  return {std::max(0.0, products.trace()), pairs.values,
          normalised(project_on_fields(clip_, origin_, pairs.vectors), pairs.values)};
}

TimeComponents VertexProducts::beyond_pose(const MatrixXd& pose, Index most,
                                           double smallest) const {
  const auto frames = static_cast<double>(clip_.frame_count);
  const VectorXd still = pose.transpose().reshaped();
  VectorXd sum(still.size());  // of all frames
  const VectorXd once = VectorXd::Ones(static_cast<Index>(clip_.frame_count));
  combine_rows(clip_, origin_, once, [&](size_t first, const MatrixXd& block) {
    sum.segment(static_cast<Index>(3 * first), block.rows()) = block;
  });
  MatrixXd products = shape_gram();
  products += still * (frames * still - sum).transpose() - sum * still.transpose();
  Eigenpairs pairs = pairs_of(products, most, smallest, energy());
  MatrixXd time = project_on_fields(clip_, origin_, pairs.vectors);
  time.rowwise() -= still.transpose() * pairs.vectors;
  return {std::max(0.0, products.trace()), pairs.values, normalised(time, pairs.values)};
}

}  // namespace anicodec
