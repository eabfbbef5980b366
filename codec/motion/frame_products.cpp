// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/motion/frame_products.h"

#include "codec/algebra/blocked_product.h"
#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/trajectory_gram.h"

#include <algorithm>
#include <utility>

#include <Eigen/Eigenvalues>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

TimeComponents components_of(const MatrixXd& products, Index most, double smallest) {
  Eigenpairs pairs = leading_eigenpairs(products, most, smallest);
  return {std::max(0.0, products.trace()), std::move(pairs.values), std::move(pairs.vectors)};
}

}  // namespace

FrameProducts::FrameProducts(const FrameView& clip, const Vector3d& origin, const VectorXd& sums)
    : FrameProducts(clip, origin, sums, trajectory_gram(clip, origin)) {}

FrameProducts::FrameProducts(const FrameView& clip, const Vector3d& origin, const VectorXd& sums,
                             MatrixXd gram)
    : clip_(clip), origin_(origin), sums_(sums), gram_(std::move(gram)) {}

std::unique_ptr<const FrameProducts> FrameProducts::of_frames(size_t first, size_t count,
                                                              const Vector3d& shift,
                                                              const VectorXd& sums) const {
  constexpr double kMostLost = 1e6;  // of the products, where the frames are far from this origin
  const auto from = static_cast<Index>(3 * first), rows = static_cast<Index>(3 * count);
  const VectorXd of_origin = sums_.segment(from, rows), shifts = shift.replicate(rows / 3, 1);
  MatrixXd gram = gram_.block(from, from, rows, rows);
  const double before = gram.trace();
  gram -= sums * shifts.transpose() + shifts * of_origin.transpose();
  if (before > kMostLost * gram.trace())
    return nullptr;
  return std::unique_ptr<const FrameProducts>(
      new FrameProducts(clip_.frames(first, count), origin_ + shift, sums, std::move(gram)));
}

double FrameProducts::energy() const {
  return gram_.trace();
}

// All that is needed about a frame as a set of functions is in the Gram matrix.
size_t FrameProducts::best_frame() const {
  size_t best = 0;
  double most = -1;
  const auto n = static_cast<double>(clip_.vertex_count);
  for (Index f = 0; f < gram_.rows() / 3; ++f) {
    // Products of the functions x, y, z about their means with each other and with all rows.
    const VectorXd frame_sums = sums_.segment<3>(3 * f);
    const MatrixXd axes_gram =
        gram_.block<3, 3>(3 * f, 3 * f) - frame_sums * frame_sums.transpose() / n;
    const MatrixXd rows = gram_.middleCols<3>(3 * f) - sums_ * frame_sums.transpose() / n;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(axes_gram);
    double explained = 0;
    for (Index a = 0; a < 3; ++a) {
      const double size = solver.eigenvalues()[a];
      if (size > 1e-9 * solver.eigenvalues()[2])
        explained += (rows * solver.eigenvectors().col(a)).squaredNorm() / size;
    }
    if (explained > most) {
      most = explained;
      best = static_cast<size_t>(f);
    }
  }
  return best;
}

MatrixXd FrameProducts::leading_trajectories(Index count) const {
  const auto n = static_cast<double>(clip_.vertex_count);
  return leading_eigenpairs(gram_ - sums_ * sums_.transpose() / n, count, 0).vectors;
}

MatrixXd FrameProducts::space_of_trajectories(Index count) const {
  constexpr Index kDirect = 144;  // rows, up to which no Krylov space is smaller
  if (gram_.rows() <= std::max(count, kDirect))
    return leading_trajectories(count);
  const auto times_gram = [&](const MatrixXd& columns) { return product(gram_, columns); };
  return leading_eigenspace(times_gram, gram_.rows(), count / 3, count).vectors;
}

VectorXd FrameProducts::frame_energies(Index most) const {
  return leading_eigenpairs(sum_of_axes(gram_), most, 0).values;
}

TimeComponents FrameProducts::beyond_span(BasisKind kind, const MatrixXd& span, Index most,
                                          double smallest) const {
  MatrixXd remainder = gram_;
  const MatrixXd fitted = project_on_functions(clip_, origin_, span);
  remainder -= fitted * fitted.transpose();
  if (kind == BasisKind::kEigenshapes)
    remainder = sum_of_axes(remainder);
  return components_of(remainder, most, smallest);
}

TimeComponents FrameProducts::beyond_pose(const MatrixXd& pose, Index most, double smallest) const {
  MatrixXd remainder = sum_of_axes(gram_);
  // <x_f - p, x_g - p> from <x_f, p>.
  const Index frames = remainder.rows();
  VectorXd products(frames);
  const double pose_energy = pose.squaredNorm();
  for (Index f = 0; f < frames; ++f) {
    const float* x = clip_.frame(static_cast<size_t>(f));
    double s = 0;
    for (Index v = 0; v < pose.rows(); ++v, x += 3)
      for (Index c = 0; c < 3; ++c)
        s += (double{x[c]} - origin_[c]) * pose(v, c);
    products[f] = s;
  }
  for (Index g = 0; g < frames; ++g)
    for (Index f = 0; f < frames; ++f)
      remainder(f, g) += pose_energy - products[f] - products[g];
  return components_of(remainder, most, smallest);
}

}  // namespace anicodec
