// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MOTION_VERTEX_PRODUCTS_H_
#define ANICODEC_CODEC_MOTION_VERTEX_PRODUCTS_H_

#include "codec/motion/motion_products.h"

#include <cstddef>
#include <mutex>

namespace anicodec {

/// By the products of all pairs of vertices, summed over the frames: for long clips of few vertices. The vertices
/// may be those of a sketch, sums over all vertices by orthonormal functions: functions of the vertices are then
/// given by their products with these.
class VertexProducts : public MotionProducts {
 public:
  /// `ones`: the function that is 1 at every one of `real_vertices`. Cost O(frames vertices^2), memory
  /// vertices^2 doubles, nine times as many once shapes are asked for, and two to three times that while
  /// components are found.
  VertexProducts(const FrameView& clip, const Eigen::Vector3d& origin, Eigen::VectorXd ones,
                 size_t real_vertices);

  double energy() const override { return gram_.trace(); }

  size_t best_frame() const override;
  Eigen::MatrixXd leading_trajectories(Eigen::Index count) const override;
  Eigen::VectorXd frame_energies(Eigen::Index most) const override;
  TimeComponents beyond_span(BasisKind kind, const Eigen::MatrixXd& span, Eigen::Index most,
                             double smallest) const override;
  TimeComponents beyond_pose(const Eigen::MatrixXd& pose, Eigen::Index most,
                             double smallest) const override;

 private:
  const Eigen::MatrixXd& shape_gram() const;
  TimeComponents trajectories(const Eigen::MatrixXd& span, Eigen::Index most,
                              double smallest) const;
  TimeComponents shapes(const Eigen::MatrixXd& span, Eigen::Index most, double smallest) const;

  FrameView clip_;
  Eigen::Vector3d origin_;
  Eigen::VectorXd ones_;
  double real_vertices_;
  Eigen::MatrixXd gram_;                ///< vertices x vertices, all axes
  mutable std::mutex mutex_;            ///< of shape_gram_
  mutable Eigen::MatrixXd shape_gram_;  ///< 3 vertices x 3 vertices; empty: not made yet
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MOTION_VERTEX_PRODUCTS_H_
