// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_basis.h"

#include "codec/algebra/gram.h"
#include "codec/algebra/trajectory_gram.h"
#include "codec/motion/frame_products.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"

#include <utility>

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

/// The three leading trajectories of a clip, mapped onto a pose; that pose if they look nothing like the mesh.
MatrixXd rank_three_pose(const FrameView& clip, const Vector3d& origin, const MatrixXd& leading,
                         const MatrixXd& target) {
  if (leading.cols() < 3)
    return target;
  MatrixXd functions(target.rows(), 3);
  combine_rows(clip, origin, leading, [&](size_t first, const MatrixXd& block) {
    functions.middleRows(static_cast<Index>(first), block.rows()) = block;
  });
  const MatrixXd span = affine_span(functions);
  const MatrixXd pose = span * (span.transpose() * target);
  const double size = (target.rowwise() - target.colwise().mean()).squaredNorm();
  return (pose - target).squaredNorm() < 0.3 * size ? pose : target;
}

}  // namespace

LinearAnalysis::LinearAnalysis(const FrameView& clip) : clip_(clip) {
  measure();
}

void LinearAnalysis::measure() {
  const Centroids centroids = frame_centroids(clip_);
  origin_ = centroids.colwise().mean().transpose();
  sums_.resize(3 * centroids.rows());
  for (Index f = 0; f < centroids.rows(); ++f)
    sums_.segment<3>(3 * f) =
        static_cast<double>(clip_.vertex_count) * (centroids.row(f).transpose() - origin_);
  products_ = motion_products(clip_, origin_, sums_);
  set_reference();
}

void LinearAnalysis::set_reference() {
  kg_reference_ =
      products_->energy() - sums_.squaredNorm() / static_cast<double>(clip_.vertex_count);
}

LinearAnalysis::LinearAnalysis(const LinearAnalysis& whole, size_t first_frame, size_t frame_count)
    : clip_(whole.clip_.frames(first_frame, frame_count)) {
  if (const auto* by_frames = dynamic_cast<const FrameProducts*>(whole.products_.get())) {
    const auto first = static_cast<Index>(3 * first_frame),
               rows = static_cast<Index>(3 * frame_count);
    const auto n = static_cast<double>(clip_.vertex_count);
    const VectorXd sums = whole.sums_.segment(first, rows);
    const Vector3d shift = sums.reshaped(3, rows / 3).rowwise().mean() / n;
    origin_ = whole.origin_ + shift;
    sums_ = sums - n * shift.replicate(rows / 3, 1);
    products_ = by_frames->of_frames(first_frame, frame_count, shift, sums_);
  }
  if (products_)
    set_reference();
  else
    measure();
}

size_t LinearAnalysis::fewest_fields(double squared_error) const {
  for (Index most = 48;; most *= 2) {
    const VectorXd energies = products_->frame_energies(most);
    double left = products_->energy();
    for (Index k = 0; k < energies.size(); ++k) {
      if (left <= squared_error)
        return static_cast<size_t>(k);
      left -= energies[k];
    }
    if (energies.size() < most || left <= squared_error)
      return static_cast<size_t>(energies.size());
  }
}

MatrixXd LinearAnalysis::frame(size_t f) const {
  MatrixXd pose(static_cast<Index>(clip_.vertex_count), 3);
  const float* p = clip_.frame(f);
  for (Index v = 0; v < pose.rows(); ++v, p += 3)
    pose.row(v) = (Vector3d(p[0], p[1], p[2]) - origin_).transpose();
  return pose;
}

MatrixXd LinearAnalysis::pose(ReferencePose kind, const MatrixXd* given_pose) const {
  switch (kind) {
    case ReferencePose::kMean: {
      const auto frames = static_cast<Index>(clip_.frame_count);
      MatrixXd mean_pose(static_cast<Index>(clip_.vertex_count), 3);
      const VectorXd mean = VectorXd::Constant(frames, 1 / static_cast<double>(frames));
      combine_rows(clip_, origin_, mean, [&](size_t first, const MatrixXd& block) {
        for (Index i = 0; i < block.rows(); ++i)
          mean_pose(static_cast<Index>(first) + i / 3, i % 3) = block(i, 0);
      });
      return mean_pose;
    }
    case ReferencePose::kFrame:
      return frame(products_->best_frame());
    case ReferencePose::kRankThree:
      return rank_three_pose(clip_, origin_, products_->leading_trajectories(3),
                             given_pose ? *given_pose : frame(products_->best_frame()));
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
  out.pose = this->pose(pose, given_pose);
  const auto most = static_cast<Index>(max_components);
  TimeComponents components =
      base == Base::kAffine ? products_->beyond_span(kind, affine_span(out.pose), most, smallest)
                            : products_->beyond_pose(out.pose, most, smallest);
  out.base_energy = components.base_energy;
  out.energies = std::move(components.energies);
  out.time = std::move(components.time);
  return out;
}

RegionAnalysis::RegionAnalysis(std::shared_ptr<const RegionClips> clips,
                               const std::shared_ptr<const MatrixXd>& space)
    : clips_(std::move(clips)), regions_(clips_->count()) {
  parallel_for(size_t{0}, regions_.size(), [&](size_t r) {
    const FrameView clip = clips_->clip(r);
    Vector3d origin = Vector3d::Zero();
    if (clip.vertex_count > 0)
      origin = frame_centroids(clip).colwise().mean().transpose();
    regions_[r].emplace(Region{origin, SpaceProducts(clip, origin, space)});
  });
}

LinearBasis RegionAnalysis::basis_of(size_t region, const MatrixXd& pose, bool rank_three,
                                     size_t max_components) const {
  const auto& [origin, products] = *regions_[region];
  LinearBasis out;
  out.origin = origin;
  out.pose = rank_three ? rank_three_pose(clips_->clip(region), origin,
                                          products.leading_trajectories(3), pose)
                        : pose;
  TimeComponents components =
      products.beyond_span(affine_span(out.pose), static_cast<Index>(max_components), 0);
  out.base_energy = components.base_energy;
  out.energies = std::move(components.energies);
  out.time = std::move(components.time);
  return out;
}

LinearBasis RegionAnalysis::basis(const LinearAnalysis& whole, ReferencePose pose,
                                  size_t max_components, const MatrixXd* given_pose) const {
  LinearBasis out;
  out.origin = whole.origin();
  out.clips = clips_;
  // The leading trajectories of a region, mapped onto a frame that all regions share.
  const bool by_region = pose == ReferencePose::kRankThree;
  out.pose = whole.pose(by_region ? ReferencePose::kFrame : pose, given_pose);
  out.regions.resize(regions_.size());
  parallel_for(size_t{0}, regions_.size(), [&](size_t r) {
    out.regions[r] =
        basis_of(r, out.pose(clips_->vertices(r), Eigen::all), by_region, max_components);
  });
  for (size_t r = 0; r < out.regions.size(); ++r) {
    out.pose(clips_->vertices(r), Eigen::all) = out.regions[r].pose;
    out.base_energy += out.regions[r].base_energy;
  }
  return out;
}

}  // namespace anicodec
