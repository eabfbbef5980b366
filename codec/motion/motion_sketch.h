// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MOTION_MOTION_SKETCH_H_
#define ANICODEC_CODEC_MOTION_MOTION_SKETCH_H_

#include "codec/motion/motion_products.h"

#include <map>
#include <memory>
#include <mutex>

namespace anicodec {

/// By the leading trajectories of the clip, each as long as its singular value: the clip that has them for
/// vertices has nearly the products of all frames, and few vertices (randomised block Krylov iteration, Musco and
/// Musco 2015). For clips of many frames and many vertices.
class MotionSketch : public MotionProducts {
 public:
  /// Cost of each sketch, made when so many components are first asked for: O(frames vertices components),
  /// some passes over the clip; memory some times 3 frames x components doubles. Safe for threads.
  MotionSketch(const FrameView& clip, const Eigen::Vector3d& origin, const Eigen::VectorXd& sums);
  ~MotionSketch() override;

  double energy() const override { return energy_; }

  size_t best_frame() const override;
  Eigen::MatrixXd leading_trajectories(Eigen::Index count) const override;
  Eigen::VectorXd frame_energies(Eigen::Index most) const override;
  TimeComponents beyond_span(BasisKind kind, const Eigen::MatrixXd& span, Eigen::Index most,
                             double smallest) const override;
  TimeComponents beyond_pose(const Eigen::MatrixXd& pose, Eigen::Index most,
                             double smallest) const override;

 private:
  class Rows;

  const Rows& rows_for(Eigen::Index components) const;

  FrameView clip_;
  Eigen::Vector3d origin_;
  Eigen::VectorXd sums_;
  double energy_;
  mutable std::mutex mutex_;
  /// By the components they are good for.
  mutable std::map<Eigen::Index, std::unique_ptr<const Rows>> made_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MOTION_MOTION_SKETCH_H_
