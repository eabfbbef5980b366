// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAMES_KEYFRAME_FIT_H_
#define ANICODEC_CODEC_KEYFRAMES_KEYFRAME_FIT_H_

#include "codec/algebra/gram.h"
#include "codec/algebra/rigid_motion.h"
#include "codec/keyframes/keyframe_selection.h"
#include "codec/sequence/frame_view.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// How frames are combined from key-frames.
enum class KeyframeWeights : uint8_t {
  kLinear,    ///< x_f ~ m + sum_j w_fj (x_kj - m), m the clip's mean position
  kSumToOne,  ///< x_f ~ sum_j w_fj x_kj, weights sum to one
  kRigid,     ///< x_f ~ R_f (sum_j w_fj A_j) + t_f, A_j the aligned key-frames, weights sum to one
};

/// A clip expressed by key-frames.
struct KeyframeFit {
  std::vector<uint32_t> keyframes;   ///< ascending
  Eigen::MatrixXd weights;           ///< frames x key-frames; unit vectors for key-frames
  Eigen::VectorXd squared_errors;    ///< per frame: summed over its vertices
  std::vector<RigidMotion> motions;  ///< per frame, for kRigid only

  double squared_error() const { return squared_errors.sum(); }

  /// Mean over the frames: the squared error of a frame for one of 1 in every key-frame.
  double noise_gain() const { return weights.squaredNorm() / static_cast<double>(weights.rows()); }
};

/// Expresses a clip by key-frames: the inner products are computed once, for any number of fits.
/// The view must outlive the object; not for use by several threads at a time.
class KeyframeFitter {
 public:
  /// Cost O(vertices frames^2), memory frames^2 doubles. The clip has a frame and a vertex.
  explicit KeyframeFitter(const FrameView& clip);

  const FrameView& clip() const { return clip_; }

  const FrameGram& gram() const { return gram_; }

  /// frames x frames products that the key-frames of this kind are chosen and fitted by: positions
  /// relative to the clip's mean position, or aligned frames for kRigid (first use: another pass).
  const Eigen::MatrixXd& products(KeyframeWeights kind);

  /// Chooses count key-frames, 1 <= count <= frames, and fits. Fewer come out where more would be
  /// of no use (select_keyframes()). kRigid reads the vertices once more for the key-frames that
  /// are new to it, O(vertices frames count). Asked once more, small fits cost nothing: they are kept.
  KeyframeFit fit(size_t count, KeyframeMethod method, KeyframeWeights kind);

  /// Fits to given key-frames: ascending, in range, not repeated. Weights that would enlarge the
  /// rounding of the key-frames, because these are nearly dependent, are fitted with that rounding
  /// in mind.
  KeyframeFit fit(std::vector<uint32_t> keyframes, KeyframeWeights kind);

  /// Errors of exact key-frames and weights: KG in per cent, RMSE in scene units.
  double kg(const KeyframeFit& fit) const;
  double rmse(const KeyframeFit& fit) const;

 private:
  KeyframeFit chosen_fit(size_t count, KeyframeMethod method, KeyframeWeights kind);
  void align();
  std::vector<Eigen::Matrix3d> unturned() const;
  KeyframeFit fit_rigid(const std::vector<uint32_t>& keyframes,
                        const std::vector<Eigen::Matrix3d>& rotations, double noise);

  FrameView clip_;
  FrameGram gram_;
  Eigen::MatrixXd centred_;
  std::vector<Eigen::Matrix3d> rotations_;  // empty until aligned
  Eigen::MatrixXd aligned_;
  std::optional<CrossProducts> cross_;
  std::map<std::tuple<size_t, KeyframeMethod, KeyframeWeights>, KeyframeFit> kept_;
  size_t kept_bytes_ = 0;
};

/// The aligned key-frame A_j: frame f turned back about its centroid, R_f^T (x_f - t_f);
/// vertex_count x 3.
std::vector<float> aligned_frame(const FrameView& clip, size_t f, const RigidMotion& motion);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAMES_KEYFRAME_FIT_H_
