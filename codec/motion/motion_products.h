// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MOTION_MOTION_PRODUCTS_H_
#define ANICODEC_CODEC_MOTION_MOTION_PRODUCTS_H_

#include "codec/sequence/frame_view.h"
#include "format/records.h"

#include <cstddef>
#include <memory>

#include <Eigen/Core>

namespace anicodec {

/// Frames, or vertices where these are fewer, up to which all pairs of them are multiplied; beyond, a sketch has
/// what the leading components need. Key-frames are searched for among so many frames at most: limb, repeats, cuts,
/// face and rigid of the corpus, 300 vertices and 700 frames, do better with principal components.
inline constexpr size_t kMostMultiplied = 512;

/// Principal components in time.
struct TimeComponents {
  double base_energy = 0;    ///< squares of what the components are of: the sum of all energies
  Eigen::VectorXd energies;  ///< squared singular values, descending
  /// A column per component, orthonormal: 3 frames (trajectories) or frames (shapes).
  Eigen::MatrixXd time;
};

/// Inner products of the coordinates of a clip, as far as principal components need them. Positions are relative
/// to an origin. Rank and energies are those of one matrix, 3 frames x vertices: the smaller side is enough.
class MotionProducts {
 public:
  virtual ~MotionProducts() = default;

  /// Sum of all squares.
  virtual double energy() const = 0;

  /// The frame whose affine images explain most of the clip; of a long clip, the best of some.
  virtual size_t best_frame() const = 0;

  /// The leading trajectories about the centroids: 3 frames x at most `count`.
  virtual Eigen::MatrixXd leading_trajectories(Eigen::Index count) const = 0;

  /// About `count` orthonormal trajectories, whose span has about the leading third of as many: the others guess at
  /// what is left.
  virtual Eigen::MatrixXd space_of_trajectories(Eigen::Index count) const {
    return leading_trajectories(count);
  }

  /// Squared singular values of whole frames, the largest.
  virtual Eigen::VectorXd frame_energies(Eigen::Index most) const = 0;

  /// At most so many components, with energies above `smallest`, of what orthonormal functions of the vertices
  /// (vertices x some) leave in every frame.
  virtual TimeComponents beyond_span(BasisKind kind, const Eigen::MatrixXd& span, Eigen::Index most,
                                     double smallest) const = 0;

  /// The same, shapes, of what a pose (vertices x 3) leaves.
  virtual TimeComponents beyond_pose(const Eigen::MatrixXd& pose, Eigen::Index most,
                                     double smallest) const = 0;
};

/// Sum of all squared coordinates relative to an origin. Same bits for any number of threads.
double motion_energy(const FrameView& clip, const Eigen::Vector3d& origin);

/// The products of a clip, which must outlive them: frame by frame, vertex by vertex, or by a sketch. `sums`: of the
/// coordinates over the vertices, 3 frames.
std::unique_ptr<const MotionProducts> motion_products(const FrameView& clip,
                                                      const Eigen::Vector3d& origin,
                                                      const Eigen::VectorXd& sums);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MOTION_MOTION_PRODUCTS_H_
