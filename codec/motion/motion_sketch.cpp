// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/motion/motion_sketch.h"

#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/trajectory_gram.h"
#include "codec/motion/vertex_products.h"
#include "codec/sequence/frame_array.h"

#include <algorithm>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// A base takes out of the leading trajectories at most as many as it has functions, and what is then left of them
// comes next.
constexpr Index kOfBase = 16;
constexpr Index kFewestSketched = 48;
// A space of all components has so many columns more: its first block lies in part outside of the
// motion, and so do blocks that come when little motion is left. Noise of 592 to 608 vertices lost
// the last 8 to 16 components with half as many.
constexpr Index kBeyondRank = 32;

}  // namespace

/// The clip of few vertices.
class MotionSketch::Rows {
 public:
  Rows(const FrameView& clip, const Vector3d& origin, const VectorXd& sums, Index components) {
    const auto times_gram = [&](const MatrixXd& columns) {
      return times_trajectory_gram(clip, origin, columns);
    };
    const Index wanted = components + kOfBase, rank = static_cast<Index>(clip.vertex_count);
    const Eigenpairs pairs = leading_eigenspace(times_gram, sums.size(), wanted,
                                                std::min(2 * wanted, rank + kBeyondRank));
    energies_ = pairs.values;
    const Index rows = pairs.values.size();
    positions_.resize(clip.frame_count * static_cast<size_t>(3 * rows));
    float* to = positions_.data();
    const VectorXd sizes = energies_.cwiseSqrt();
    for (Index f = 0; f < static_cast<Index>(clip.frame_count); ++f)
      for (Index i = 0; i < rows; ++i)
        for (Index c = 0; c < 3; ++c)
          *to++ = static_cast<float>(sizes[i] * pairs.vectors(3 * f + c, i));
    view_ = FrameView(positions_.data(), clip.frame_count, static_cast<size_t>(rows));
    products_ = std::make_unique<const VertexProducts>(view_, Vector3d::Zero(), of(sums),
                                                       clip.vertex_count);
  }

  const VertexProducts& products() const { return *products_; }

  /// Functions of the vertices of the clip, given by their products with its coordinate rows, as functions of these
  /// vertices.
  MatrixXd of(const MatrixXd& products) const {
    MatrixXd out = MatrixXd::Zero(energies_.size(), products.cols());
    combine_rows(view_, Vector3d::Zero(), products, [&](size_t first, const MatrixXd& block) {
      out.middleRows(static_cast<Index>(first), block.rows()) = block;
    });
    return energies_.cwiseInverse().asDiagonal() * out;
  }

 private:
  VectorXd energies_;
  FrameArray positions_;
  FrameView view_;
  std::unique_ptr<const VertexProducts> products_;
};

MotionSketch::MotionSketch(const FrameView& clip, const Vector3d& origin, const VectorXd& sums)
    : clip_(clip), origin_(origin), sums_(sums), energy_(motion_energy(clip, origin)) {}

MotionSketch::~MotionSketch() = default;

const MotionSketch::Rows& MotionSketch::rows_for(Index components) const {
  const Index good_for = std::max(components, kFewestSketched);
  const std::scoped_lock lock(mutex_);
  std::unique_ptr<const Rows>& rows = made_[good_for];
  // Isolated: a thread that waits for others in it must not take a task that waits for the lock.
  if (!rows)
    isolated([&] { rows = std::make_unique<const Rows>(clip_, origin_, sums_, good_for); });
  return *rows;
}

size_t MotionSketch::best_frame() const {
  return rows_for(0).products().best_frame();
}

MatrixXd MotionSketch::leading_trajectories(Index count) const {
  return rows_for(count).products().leading_trajectories(count);
}

VectorXd MotionSketch::frame_energies(Index most) const {
  return rows_for(most).products().frame_energies(most);
}

TimeComponents MotionSketch::beyond_span(BasisKind kind, const MatrixXd& span, Index most,
                                         double smallest) const {
  const Rows& rows = rows_for(most);
  const MatrixXd fitted = project_on_functions(clip_, origin_, span);
  TimeComponents components = rows.products().beyond_span(kind, rows.of(fitted), most, smallest);
  components.base_energy = std::max(0.0, energy_ - fitted.squaredNorm());
  return components;
}

TimeComponents MotionSketch::beyond_pose(const MatrixXd& pose, Index most, double smallest) const {
  const Rows& rows = rows_for(most);
  const MatrixXd fitted = project_on_functions(clip_, origin_, pose);
  TimeComponents components = rows.products().beyond_pose(rows.of(fitted), most, smallest);
  double products = 0;  // of every frame and the pose
  for (Index r = 0; r < fitted.rows(); ++r)
    products += fitted(r, r % 3);
  const auto frames = static_cast<double>(clip_.frame_count);
  components.base_energy = std::max(0.0, energy_ - 2 * products + frames * pose.squaredNorm());
  return components;
}

}  // namespace anicodec
