// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ALGEBRA_GRAM_H_
#define ANICODEC_CODEC_ALGEBRA_GRAM_H_

#include "codec/sequence/frame_view.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// frames x 3: the mean position of every frame.
using Centroids = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// All inner products between the frames of a clip. Key-frame selection, weights, errors and
/// principal components are functions of these alone, so their cost does not depend on the number
/// of vertices. The products are split into shape (every frame about its own centroid) and motion
/// of the centroids: nothing cancels when a small object travels far.
struct FrameGram {
  size_t vertex_count = 0;
  Centroids centroids;
  Eigen::MatrixXd shape;  ///< frames x frames: sum over vertices of (x_f - c_f) . (x_g - c_g)

  size_t frame_count() const { return static_cast<size_t>(shape.rows()); }

  /// Mean position of all vertices in all frames.
  Eigen::Vector3d mean_position() const { return centroids.colwise().mean().transpose(); }

  /// frames x frames products of positions relative to mean_position().
  Eigen::MatrixXd clip_centred() const;

  /// Sum of squares that errors are compared with in the KG metric (Karni and Gotsman 2004): every
  /// frame about its own centroid.
  double kg_reference() const { return shape.trace(); }
};

/// KG error in per cent for a summed squared error; a reference of zero counts as one.
double kg_error(double squared_error, double reference);

/// Root of the mean squared distance per vertex and frame, in scene units.
double rmse(double squared_error, size_t vertices, size_t frames);

/// Mean position of every frame.
Centroids frame_centroids(const FrameView& clip);

/// Products of all pairs of frames, accumulated in double over blocks of vertices. With rotations
/// (one per frame, or none) every frame is first turned back about its centroid: R_f^T (x_f - c_f).
/// Cost O(vertices frames^2), memory frames^2 doubles and a few megabytes. Same bits for any number
/// of threads.
FrameGram frame_gram(const FrameView& clip, std::span<const Eigen::Matrix3d> rotations = {});

/// Products relative to the mean shape: rows and columns of the result sum to zero.
Eigen::MatrixXd about_mean(const Eigen::MatrixXd& gram);

/// Squared distance between two frames (vectors) from their inner products, never negative.
inline double squared_distance(const Eigen::MatrixXd& gram, Eigen::Index f, Eigen::Index g) {
  const double d = gram(f, f) + gram(g, g) - 2 * gram(f, g);
  return d > 0 ? d : 0;
}

/// 3 x 3 products C_fg = sum over vertices of (x_f - c_f)(x_g - c_g)^T between all frames f and
/// some frames g. They hold all that a rotation per frame can change in the Gram matrix.
class CrossProducts {
 public:
  /// The view must outlive the object.
  explicit CrossProducts(const FrameView& clip, Centroids centroids);

  /// Makes sure that column(g) may be used for every g of frames, which must be in range; only what
  /// is missing is computed, O(vertices frames x missing). When more than max_columns would be
  /// kept, those of earlier calls are dropped first.
  void require(std::span<const uint32_t> frames, size_t max_columns = 2000);

  /// (3 frames) x 3: rows 3f .. 3f+2 are C_fg.
  Eigen::Block<const Eigen::MatrixXd> column(uint32_t g) const;

 private:
  FrameView clip_;
  Centroids centroids_;
  Eigen::MatrixXd products_;   // 3 frames x 3 columns kept
  std::vector<int32_t> slot_;  // per frame: its column, or -1
  int32_t used_ = 0;
};

/// Squared errors that 0, 1, ... frames principal components leave; gram: frames x frames products.
/// Cost O(frames^3).
std::vector<double> principal_errors(const Eigen::MatrixXd& gram);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ALGEBRA_GRAM_H_
