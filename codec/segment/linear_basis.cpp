// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_basis.h"

#include "codec/algebra/gram.h"
#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/trajectory_gram.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"

#include <Eigen/Eigenvalues>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Orthonormal columns with the span of the given ones; dependent ones are dropped.
MatrixXd orthonormal_span(const MatrixXd& columns) {
  MatrixXd out(columns.rows(), columns.cols());
  Index count = 0;
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd c = columns.col(j);
    const double size = c.squaredNorm();
    for (int pass = 0; pass < 2; ++pass)
      c -= out.leftCols(count) * (out.leftCols(count).transpose() * c).eval();
    if (c.squaredNorm() > 1e-9 * size)
      out.col(count++) = c.normalized();
  }
  return out.leftCols(count);
}

// 1, x, y, z of a pose.
MatrixXd affine_span(const MatrixXd& pose) {
  MatrixXd columns(pose.rows(), 4);
  columns.col(0).setOnes();
  columns.rightCols(3) = pose.rowwise() - pose.colwise().mean();
  return orthonormal_span(columns);
}

}  // namespace

LinearAnalysis::LinearAnalysis(const FrameView& clip) : clip_(clip) {
  measure();
}

void LinearAnalysis::measure() {
  const Centroids centroids = frame_centroids(clip_);
  origin_ = centroids.colwise().mean().transpose();
  gram_ = trajectory_gram(clip_, origin_);
  sums_.resize(gram_.rows());
  for (Index f = 0; f < centroids.rows(); ++f)
    sums_.segment<3>(3 * f) =
        static_cast<double>(clip_.vertex_count) * (centroids.row(f).transpose() - origin_);
  kg_reference_ = gram_.trace() - sums_.squaredNorm() / static_cast<double>(clip_.vertex_count);
}

LinearAnalysis::LinearAnalysis(const LinearAnalysis& whole, size_t first_frame, size_t frame_count)
    : clip_(whole.clip_.frames(first_frame, frame_count)) {
  constexpr double kMostLost = 1e6;  // of the products, where the frames are far from the whole's origin
  const auto first = static_cast<Index>(3 * first_frame), rows = static_cast<Index>(3 * frame_count);
  const auto n = static_cast<double>(clip_.vertex_count);
  const VectorXd sums = whole.sums_.segment(first, rows);
  const Vector3d shift = sums.reshaped(3, rows / 3).rowwise().mean() / n;
  const VectorXd shifts = shift.replicate(rows / 3, 1);
  gram_ = whole.gram_.block(first, first, rows, rows);
  const double before = gram_.trace();
  gram_ += (n * shifts - sums) * shifts.transpose() - shifts * sums.transpose();
  if (before > kMostLost * gram_.trace()) {
    measure();
    return;
  }
  origin_ = whole.origin_ + shift;
  sums_ = sums - n * shifts;
  kg_reference_ = gram_.trace() - sums_.squaredNorm() / n;
}

size_t LinearAnalysis::fewest_fields(double squared_error) const {
  const MatrixXd products = sum_of_axes(gram_);
  for (Index most = 48;; most *= 2) {
    const VectorXd energies = leading_eigenpairs(products, most, 0).values;
    double left = products.trace();
    for (Index k = 0; k < energies.size(); ++k) {
      if (left <= squared_error)
        return static_cast<size_t>(k);
      left -= energies[k];
    }
    if (energies.size() < most || left <= squared_error)
      return static_cast<size_t>(energies.size());
  }
}

// All that is needed about a frame as a set of functions is in the Gram matrix.
size_t LinearAnalysis::best_frame() const {
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

MatrixXd LinearAnalysis::frame(size_t f) const {
  MatrixXd pose(static_cast<Index>(clip_.vertex_count), 3);
  const float* p = clip_.frame(f);
  for (Index v = 0; v < pose.rows(); ++v, p += 3)
    pose.row(v) = (Vector3d(p[0], p[1], p[2]) - origin_).transpose();
  return pose;
}

MatrixXd LinearAnalysis::rank_three_pose(const MatrixXd& target) const {
  const auto n = static_cast<double>(clip_.vertex_count);
  const Eigenpairs leading = leading_eigenpairs(gram_ - sums_ * sums_.transpose() / n, 3, 0);
  if (leading.values.size() < 3)
    return target;
  MatrixXd functions(target.rows(), 3);
  combine_rows(clip_, origin_, leading.vectors, [&](size_t first, const MatrixXd& block) {
    functions.middleRows(static_cast<Index>(first), block.rows()) = block;
  });
  const MatrixXd span = affine_span(functions);
  const MatrixXd pose = span * (span.transpose() * target);
  // A clip whose leading trajectories look nothing like the mesh would give a useless geometry.
  const double size = (target.rowwise() - target.colwise().mean()).squaredNorm();
  return (pose - target).squaredNorm() < 0.3 * size ? pose : target;
}

MatrixXd LinearAnalysis::pose(ReferencePose kind, const MatrixXd* given_pose) const {
  switch (kind) {
    case ReferencePose::kMean: {
      const Index frames = gram_.rows() / 3;
      MatrixXd mean_pose(static_cast<Index>(clip_.vertex_count), 3);
      const VectorXd mean = VectorXd::Constant(frames, 1 / static_cast<double>(frames));
      combine_rows(clip_, origin_, mean, [&](size_t first, const MatrixXd& block) {
        for (Index i = 0; i < block.rows(); ++i)
          mean_pose(static_cast<Index>(first) + i / 3, i % 3) = block(i, 0);
      });
      return mean_pose;
    }
    case ReferencePose::kFrame:
      return frame(best_frame());
    case ReferencePose::kRankThree:
      return rank_three_pose(given_pose ? *given_pose : frame(best_frame()));
    case ReferencePose::kGiven:
      break;
  }
  return *given_pose;
}

LinearBasis LinearAnalysis::basis(BasisKind kind, ReferencePose pose, Base base,
                                  size_t max_components, double smallest,
                                  const MatrixXd* given_pose) const {
  const bool shapes = kind == BasisKind::kEigenshapes;
  if (!shapes && (kind != BasisKind::kEigentrajectories || base != Base::kAffine))
    throw Error(ErrorKind::kInternal, "no such linear basis");
  LinearBasis out;
  out.kind = kind;
  out.base = base;
  out.origin = origin_;
  const Index frames = gram_.rows() / 3;
  out.pose = this->pose(pose, given_pose);
  MatrixXd remainder = gram_;
  if (base == Base::kAffine) {
    const MatrixXd fitted = project_on_functions(clip_, origin_, affine_span(out.pose));
    remainder -= fitted * fitted.transpose();
  }
  if (shapes)
    remainder = sum_of_axes(remainder);
  if (base == Base::kPose) {
    // <x_f - p, x_g - p> from <x_f, p>.
    VectorXd products(frames);
    double pose_energy = out.pose.squaredNorm();
    for (Index f = 0; f < frames; ++f) {
      const float* x = clip_.frame(static_cast<size_t>(f));
      double s = 0;
      for (Index v = 0; v < out.pose.rows(); ++v, x += 3)
        for (Index c = 0; c < 3; ++c)
          s += (double{x[c]} - origin_[c]) * out.pose(v, c);
      products[f] = s;
    }
    for (Index g = 0; g < frames; ++g)
      for (Index f = 0; f < frames; ++f)
        remainder(f, g) += pose_energy - products[f] - products[g];
  }
  out.base_energy = std::max(0.0, remainder.trace());
  Eigenpairs pairs = leading_eigenpairs(remainder, static_cast<Index>(max_components), smallest);
  out.energies = std::move(pairs.values);
  out.time = std::move(pairs.vectors);
  return out;
}

RegionAnalysis::RegionAnalysis(std::shared_ptr<const RegionClips> clips)
    : clips_(std::move(clips)) {
  analyses_.resize(clips_->count());
  parallel_for(size_t{0}, analyses_.size(), [&](size_t r) {
    analyses_[r] = std::make_unique<const LinearAnalysis>(clips_->clip(r));
  });
}

LinearBasis RegionAnalysis::basis(const LinearAnalysis& whole, ReferencePose pose,
                                  size_t max_components, const MatrixXd* given_pose) const {
  LinearBasis out;
  out.origin = whole.origin();
  out.clips = clips_;
  // The leading trajectories of a region, mapped onto a frame that all regions share.
  const bool by_region = pose == ReferencePose::kRankThree;
  out.pose = whole.pose(by_region ? ReferencePose::kFrame : pose, given_pose);
  out.regions.resize(analyses_.size());
  parallel_for(size_t{0}, analyses_.size(), [&](size_t r) {
    const MatrixXd rows = out.pose(clips_->vertices(r), Eigen::all);
    out.regions[r] = analyses_[r]->basis(BasisKind::kEigentrajectories,
                                         by_region ? pose : ReferencePose::kGiven, Base::kAffine,
                                         max_components, 0, &rows);
  });
  for (size_t r = 0; r < out.regions.size(); ++r) {
    out.pose(clips_->vertices(r), Eigen::all) = out.regions[r].pose;
    out.base_energy += out.regions[r].base_energy;
  }
  return out;
}

}  // namespace anicodec
