// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_REFERENCE_POSE_ENCODE_H_
#define ANICODEC_CODEC_SEGMENT_REFERENCE_POSE_ENCODE_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/segment/encoded_segment.h"
#include "format/memory.h"
#include "sdk/pose/partners.h"
#include "sdk/pose/pose_coding.h"

#include <cstdint>
#include <memory>

#include <Eigen/Core>

namespace anicodec {

/// Codes a pose (coded vertices x 3, relative to `origin`) with any step: what does not depend on it
/// is made once.
class ReferencePoseEncoder {
 public:
  /// Pose and layout must outlive the object. Cost: that of find_partners().
  ReferencePoseEncoder(const Eigen::MatrixXd& pose, const Eigen::Vector3d& origin,
                       const MeshLayout& layout);

  /// The pose, ready for the file, with the error of rounding to a grid of this step or, where
  /// coordinates would be too large, a coarser one: coded with dependent steps or exact coordinates,
  /// by partners or without, whichever is smallest. O(vertices).
  std::shared_ptr<const EncodedPose> at_step(double step) const;

 private:
  const Eigen::MatrixXd& pose_;
  Eigen::Vector3d origin_;
  PoseSurface surface_;
  PosePartners partners_;
};

/// The same for one step. `anicodec_bench pose` prints what its parts take.
std::shared_ptr<const EncodedPose> encode_reference_pose(const Eigen::MatrixXd& pose,
                                                         const Eigen::Vector3d& origin, double step,
                                                         const MeshLayout& layout);

/// The same in one way of coding, by these partners if any. The surface is that of the mesh.
std::shared_ptr<const EncodedPose> encode_pose_as(PoseCoding coding, const Eigen::MatrixXd& pose,
                                                  const Eigen::Vector3d& origin, double step,
                                                  const PoseSurface& surface,
                                                  const PosePartners* partners = nullptr);

/// The integers nearest to `values` (vertices x 3, in steps) that DependentSteps allows along each
/// axis, taking vertices in this order: the least sum of squared distances. O(vertices).
Vector<int32_t> dependent_integers(const Eigen::MatrixXd& values, const Vector<uint32_t>& order);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_REFERENCE_POSE_ENCODE_H_
