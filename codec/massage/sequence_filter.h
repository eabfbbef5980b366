// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_SEQUENCE_FILTER_H_
#define ANICODEC_CODEC_MASSAGE_SEQUENCE_FILTER_H_

#include "codec/sequence/frame_view.h"
#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Separates the motion that frames of a clip share from the noise of each frame, along its
/// principal components: a component of variance s keeps max(0, 1 - (level / s)^2) of itself. This
/// is a Wiener filter applied again to its own residual ("twicing", Tukey 1977), which hardly
/// weakens strong components. Noise that is independent from frame to frame spreads over all
/// components alike, motion over few.
class SequenceFilter {
 public:
  /// Cost O(vertices frames^2 + frames^3), memory frames^2 doubles.
  explicit SequenceFilter(const FrameView& clip);

  /// Variances of the components, descending, without those that are 0.
  const Eigen::VectorXd& variances() const { return variances_; }

  /// frames x frames: filtered frames are this times the frames. Rows sum to 1.
  Eigen::MatrixXd weights(double level) const;

 private:
  Eigen::VectorXd variances_;
  Eigen::MatrixXd vectors_;
};

/// The combination sum_g weights[g] x_g of the frames, vertices x 3.
std::vector<float> combination(const FrameView& clip, const Eigen::RowVectorXd& weights);

/// Replaces the frames from `first` on, as many as there are weights, by their combinations. In
/// parallel over vertices; the same bits for any number of threads.
void play_frames(const Eigen::MatrixXd& weights, uint32_t first, MeshSequence* sequence);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_SEQUENCE_FILTER_H_
