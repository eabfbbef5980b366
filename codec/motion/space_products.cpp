// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/motion/space_products.h"

#include "codec/algebra/blocked_product.h"
#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/trajectory_gram.h"

#include <algorithm>
#include <utility>

namespace anicodec {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

SpaceProducts::SpaceProducts(const FrameView& clip, const Vector3d& origin,
                             std::shared_ptr<const MatrixXd> space)
    : clip_(clip),
      origin_(origin),
      space_(std::move(space)),
      gram_(MatrixXd::Zero(space_->cols(), space_->cols())),
      sums_(VectorXd::Zero(space_->cols())),
      energy_(motion_energy(clip, origin)) {
  const auto depth = static_cast<size_t>(panel_depth(space_->rows()));
  MatrixXd panel;
  for (size_t first = 0; first < clip.vertex_count; first += depth) {
    trajectory_panel(clip, origin, first, std::min(depth, clip.vertex_count - first), &panel);
    const MatrixXd in_space = product(panel, *space_);
    add_self_products(in_space, gram_);
    sums_ += in_space.colwise().sum().transpose();
  }
  mirror_upper(gram_);
}

MatrixXd SpaceProducts::leading_trajectories(Index count) const {
  const auto n = static_cast<double>(std::max<size_t>(clip_.vertex_count, 1));
  return product(*space_,
                 leading_eigenpairs(gram_ - sums_ * sums_.transpose() / n, count, 0).vectors);
}

TimeComponents SpaceProducts::beyond_span(const MatrixXd& span, Index most, double smallest) const {
  const MatrixXd fitted = project_on_functions(clip_, origin_, span);
  const MatrixXd in_space = space_->transpose() * fitted;
  Eigenpairs pairs = leading_eigenpairs(gram_ - in_space * in_space.transpose(), most, smallest);
  return {std::max(0.0, energy_ - fitted.squaredNorm()), std::move(pairs.values),
          product(*space_, pairs.vectors)};
}

}  // namespace anicodec
