// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MOTION_FRAME_PRODUCTS_H_
#define ANICODEC_CODEC_MOTION_FRAME_PRODUCTS_H_

#include "codec/motion/motion_products.h"

#include <optional>

namespace anicodec {

/// By the products of all pairs of coordinate rows: for clips of few frames.
class FrameProducts : public MotionProducts {
 public:
  /// Cost O(vertices frames^2), memory 9 frames^2 doubles, and two to three times as many for components.
  FrameProducts(const FrameView& clip, const Eigen::Vector3d& origin, const Eigen::VectorXd& sums);

  double energy() const override;
  size_t best_frame() const override;
  Eigen::MatrixXd leading_trajectories(Eigen::Index count) const override;
  Eigen::MatrixXd space_of_trajectories(Eigen::Index count) const override;
  Eigen::VectorXd frame_energies(Eigen::Index most) const override;
  TimeComponents beyond_span(BasisKind kind, const Eigen::MatrixXd& span, Eigen::Index most,
                             double smallest) const override;
  TimeComponents beyond_pose(const Eigen::MatrixXd& pose, Eigen::Index most,
                             double smallest) const override;

  /// Products of some of the frames about their own mean position, which is `shift` from the origin; the sums are
  /// about that. Null if too little of the numbers would be left. Cost O(frames^2).
  std::unique_ptr<const FrameProducts> of_frames(size_t first, size_t count,
                                                 const Eigen::Vector3d& shift,
                                                 const Eigen::VectorXd& sums) const;

 private:
  FrameProducts(const FrameView& clip, const Eigen::Vector3d& origin, const Eigen::VectorXd& sums,
                Eigen::MatrixXd gram);

  FrameView clip_;
  Eigen::Vector3d origin_;
  Eigen::VectorXd sums_;
  Eigen::MatrixXd gram_;  ///< 3 frames x 3 frames
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MOTION_FRAME_PRODUCTS_H_
