// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAMES_KEYFRAME_SELECTION_H_
#define ANICODEC_CODEC_KEYFRAMES_KEYFRAME_SELECTION_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// How key-frames are chosen.
enum class KeyframeMethod : uint8_t {
  kGas,      ///< frames nearest to the prototypes of batch Neural Gas (thesis chapter 5)
  kPivot,    ///< pivoted Cholesky factorisation of the Gram matrix, then exchanges
  kUniform,  ///< the middles of equal parts of the clip
};

/// The kind of weights that the key-frames are chosen for: the flat that they span contains the origin (linear)
/// or need not (affine: weights that sum to one).
enum class KeyframeSpan : uint8_t { kLinear, kAffine };

/// Chooses key-frames from the frames x frames inner products; 1 <= count <= frames. Returns them
/// ascending, at least one. Repeated frames: gas and uniform take each pose once, pivot takes no
/// frame that the others already reproduce; so fewer than count come out where more would be of no
/// use. Gas runs from three starts (one evenly spaced, two drawn with fixed seeds) and keeps the
/// key-frames that leave the smallest error. Cost O(300 count frames^2) for gas, O(count frames^2)
/// for pivot. Deterministic.
std::vector<uint32_t> select_keyframes(const Eigen::MatrixXd& gram, size_t count,
                                       KeyframeMethod method,
                                       KeyframeSpan span = KeyframeSpan::kLinear);

/// Exchanges: every key-frame in turn is replaced by the frame that leaves the smallest summed
/// squared error of all frames against the linear span, if that is smaller than before; a few
/// passes, while they pay. Key-frames must be linearly independent. Cost O(frames^2 key-frames) for
/// a pass.
void exchange_keyframes(const Eigen::MatrixXd& gram, std::vector<uint32_t>& keyframes);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAMES_KEYFRAME_SELECTION_H_
