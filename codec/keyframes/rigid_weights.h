// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAMES_RIGID_WEIGHTS_H_
#define ANICODEC_CODEC_KEYFRAMES_RIGID_WEIGHTS_H_

#include "codec/algebra/gram.h"
#include "codec/keyframes/keyframe_weights.h"

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Weights of every frame with one rotation per frame.
struct RigidWeights {
  Eigen::MatrixXd weights;                 ///< frames x key-frames
  Eigen::VectorXd squared_errors;          ///< per frame: summed over its vertices
  std::vector<Eigen::Matrix3d> rotations;  ///< per frame
};

/// Fits x_f - c_f ~ R_f sum_j w_fj A_j, where c_f is the frame's centroid and
/// A_j = R_kj^T (x_kj - c_kj) the aligned key-frame. Starting from the given rotations, weights and
/// rotation of every frame are improved in turns, then the rotations of the key-frames, and so on
/// while it pays. Key-frames themselves get unit vectors. products must hold the columns of the
/// key-frames, shape_gram is FrameGram::shape; `noise` as for fit_weights(). The cost, O(rounds x frames x key-frames^2), does
/// not depend on the number of vertices; deterministic for any number of threads.
RigidWeights fit_rigid_weights(const CrossProducts& products, std::span<const uint32_t> keyframes,
                               std::span<const Eigen::Matrix3d> rotations,
                               const Eigen::MatrixXd& shape_gram, WeightConstraint constraint,
                               double noise = 0);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAMES_RIGID_WEIGHTS_H_
