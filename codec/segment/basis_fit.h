// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_BASIS_FIT_H_
#define ANICODEC_CODEC_SEGMENT_BASIS_FIT_H_

#include "codec/segment/coefficient_encoder.h"
#include "codec/segment/linear_basis.h"
#include "codec/sequence/frame_view.h"
#include "format/memory.h"
#include "sdk/segment/segment.h"

#include <cstddef>

#include <Eigen/Core>

namespace anicodec {

/// Weights in time: a row per frame, or three per frame (row 3f + axis) for trajectories and bases.
struct TimeWeights {
  Eigen::MatrixXd base;        ///< a column per affine function; none for a base that does not move
  Eigen::MatrixXd components;  ///< a column per component
};

/// The vertices of a region, or of the whole, while their basis is coded: weights and coefficients,
/// each fitted to what the decoder gets of the other.
class BasisFit {
 public:
  /// The first `components` of a basis. Clip and basis must outlive the object.
  BasisFit(const FrameView& clip, const LinearBasis& basis, size_t components);

  /// Takes the pose of these vertices, three integers each on a grid.
  void set_pose(const Vector<int32_t>& points, const Eigen::Vector3d& origin, double step);

  size_t components() const { return count_; }

  /// The weights that are coded first. One pass over the clip.
  TimeWeights exact_weights() const;

  /// The weights as a decoder gets them.
  void set_decoded(TimeWeights weights) { decoded_ = std::move(weights); }

  /// The coefficients that go best with the decoded weights, in steps. One pass over the clip.
  Coefficients targets(double step) const;

  /// The weights that go best with coefficients as decoded, in steps. One pass over the clip.
  TimeWeights refitted(const Coefficients& decoded, double step) const;

 private:
  Eigen::MatrixXd fields_of(const Coefficients& decoded, double step) const;
  Eigen::MatrixXd products_of_base(const Eigen::MatrixXd& fields) const;

  FrameView clip_;
  const LinearBasis& basis_;
  size_t count_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::MatrixXd functions_;  ///< of an affine base: vertices x 4
  Eigen::MatrixXd still_;      ///< the pose as a base, vertices x 3
  TimeWeights decoded_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_BASIS_FIT_H_
