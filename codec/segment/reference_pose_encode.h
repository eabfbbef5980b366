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
  ///   bytes_per_nanosecond   what a nanosecond of opening is worth
  ReferencePoseEncoder(const Eigen::MatrixXd& pose, const Eigen::Vector3d& origin,
                       const MeshLayout& layout, double bytes_per_nanosecond);

  /// The pose, ready for the file, with the error of rounding to a grid of this step or, where
  /// coordinates would be too large, a coarser one: by partners or without, with dependent steps or exact
  /// coordinates, whichever is smallest, what opening is worth included. O(vertices).
  std::shared_ptr<const EncodedPose> at_step(double step) const;

 private:
  double cost(const EncodedPose& pose, bool has_partners) const;

  const Eigen::MatrixXd& pose_;
  Eigen::Vector3d origin_;
  double bytes_per_nanosecond_;
  CornerTable table_;
  PosePartners partners_;
};

/// The same for one step. `anicodec_bench pose` prints what its parts take.
std::shared_ptr<const EncodedPose> encode_reference_pose(const Eigen::MatrixXd& pose,
                                                         const Eigen::Vector3d& origin, double step,
                                                         const MeshLayout& layout,
                                                         double bytes_per_nanosecond = 0);

/// The same by these partners, if any. The table is that of the mesh.
std::shared_ptr<const EncodedPose> encode_pose_by(const PosePartners* partners,
                                                  const Eigen::MatrixXd& pose,
                                                  const Eigen::Vector3d& origin, double step,
                                                  const CornerTable& table);

/// The integers nearest to `values` (vertices x 3, in steps) that DependentSteps allows along each
/// axis: the least sum of squared distances. O(vertices).
Vector<int32_t> dependent_integers(const Eigen::MatrixXd& values);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_REFERENCE_POSE_ENCODE_H_
