// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_RIGID_MOTION_H_
#define ANICODEC_CODEC_ALGEBRA_RIGID_MOTION_H_

#include "codec/algebra/gram.h"
#include "codec/sequence/frame_view.h"

#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// x -> rotation x + translation.
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< proper: determinant one
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// The rotation R that maximises tr(R^T m), for m = sum over points of target source^T the best
/// rotation of source onto target (Kabsch 1976; Umeyama 1991). Never a reflection. If m leaves it
/// open (points on a line, all points alike) the rotation nearest to prior is taken.
Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& m,
                              const Eigen::Matrix3d& prior = Eigen::Matrix3d::Identity());

/// The rigid motion that best maps source onto target in the least-squares sense; n x 3 floats
/// each.
RigidMotion fit_rigid_motion(std::span<const float> source, std::span<const float> target);

/// Rotations R_f that bring all frames into one orientation: R_f^T (x_f - c_f) lies close to the
/// mean of all frames so turned (generalised Procrustes analysis, Gower 1975). The first frame
/// keeps its orientation. Linear in vertices x frames, a few passes; same bits for any number of
/// threads.
std::vector<Eigen::Matrix3d> align_frames(const FrameView& clip, const Centroids& centroids);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_RIGID_MOTION_H_
