// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAMES_KEYFRAME_WEIGHTS_H_
#define ANICODEC_CODEC_KEYFRAMES_KEYFRAME_WEIGHTS_H_

#include "codec/algebra/pivoted_cholesky.h"

#include <cstdint>
#include <span>

#include <Eigen/Core>

namespace anicodec {

enum class WeightConstraint : uint8_t {
  kNone,      ///< free weights
  kSumToOne,  ///< weights sum to one: moving the whole clip does not change them
};

/// Least-squares weights of vectors against fixed key vectors, from inner products alone. Key
/// vectors that the others reproduce get weight zero.
class WeightSolver {
 public:
  /// key_gram: keys x keys inner products, keys >= 1. `noise`: as for fit_weights().
  WeightSolver(Eigen::MatrixXd key_gram, WeightConstraint constraint, double noise = 0);

  /// products: keys x vectors inner products with the keys. Returns keys x vectors weights.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& products) const;

 private:
  Eigen::MatrixXd key_gram_;
  WeightConstraint constraint_;
  Eigen::MatrixXd differences_;  // products of the keys relative to the first, for sum one
  PivotedCholesky factor_;
};

/// Weights of every frame and what they leave.
struct FrameWeights {
  Eigen::MatrixXd weights;         ///< frames x key-frames
  Eigen::VectorXd squared_errors;  ///< per frame: summed over its vertices
};

/// Expresses every frame by the key-frames (thesis section 5.2.1). gram: frames x frames inner
/// products of the coordinates that are combined; for free weights that is
/// FrameGram::clip_centred(), so x_f - m ~ sum_j w_fj (x_kj - m) with m the clip's mean position. A
/// key-frame's own weights are exactly a unit vector. `noise`: squared length of the error that each
/// key-frame will have when it is coded; the weights are the best for such key-frames (ridge
/// regression), the errors those of exact ones. Key-frames in range and not repeated. Cost O(frames
/// key-frames^2).
FrameWeights fit_weights(const Eigen::MatrixXd& gram, std::span<const uint32_t> keyframes,
                         WeightConstraint constraint, double noise = 0);

/// Squared error of every frame for any weights (quantised ones, say), frames x key-frames.
Eigen::VectorXd squared_errors(const Eigen::MatrixXd& gram, std::span<const uint32_t> keyframes,
                               const Eigen::MatrixXd& weights);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAMES_KEYFRAME_WEIGHTS_H_
