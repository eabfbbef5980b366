// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MOTION_SPACE_PRODUCTS_H_
#define ANICODEC_CODEC_MOTION_SPACE_PRODUCTS_H_

#include "codec/motion/motion_products.h"
#include "codec/sequence/frame_view.h"

#include <memory>

#include <Eigen/Core>

namespace anicodec {

/// Inner products of the coordinates of some vertices within a space of trajectories: enough for the components of a
/// region once those of the whole clip are known, by matrices as small as the space (Rayleigh-Ritz).
class SpaceProducts {
 public:
  /// `space`: 3 frames x some, orthonormal columns. The clip must outlive this object. Cost O(vertices frames space), one
  /// pass over the clip; memory space^2 doubles and a few megabytes. Same bits for any number of threads.
  SpaceProducts(const FrameView& clip, const Eigen::Vector3d& origin,
                std::shared_ptr<const Eigen::MatrixXd> space);

  /// As MotionProducts::leading_trajectories() and, for eigentrajectories, beyond_span(); at most as many as the space
  /// has. Energies are at most those of the clip itself. Cost: a pass over the clip, O(space^3).
  Eigen::MatrixXd leading_trajectories(Eigen::Index count) const;
  TimeComponents beyond_span(const Eigen::MatrixXd& span, Eigen::Index most, double smallest) const;

 private:
  FrameView clip_;
  Eigen::Vector3d origin_;
  std::shared_ptr<const Eigen::MatrixXd> space_;
  Eigen::MatrixXd gram_;  ///< of the coordinates of trajectories in the space
  Eigen::VectorXd sums_;  ///< of the same over the vertices
  double energy_;         ///< of the clip
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MOTION_SPACE_PRODUCTS_H_
