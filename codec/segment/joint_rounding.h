// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_JOINT_ROUNDING_H_
#define ANICODEC_CODEC_SEGMENT_JOINT_ROUNDING_H_

#include "codec/segment/coefficient_costs.h"
#include "sdk/prediction/vertex_order.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Rounds the residuals of a component together. While the weights W of the prediction stay as they
/// are, a decoder's coefficients are linear in the residuals, y = (I - W)^-1 q: a residual moves
/// all vertices that are predicted from its own, directly or not. A residual that a vertex alone
/// would round to zero may be worth its bits there; more often one that it would keep is not.
///
/// Everything is by rank; coefficients and residuals are in steps. Memory: about half a
/// kilobyte per vertex.
class JointRounding {
 public:
  /// The order must outlive the object.
  explicit JointRounding(const VertexOrder& order) : order_(order) {}

  /// Weights of the prediction: rank x order.neighbour_count.
  /// Cost: some hundred operations per vertex.
  void set_weights(std::vector<float> weights);

  /// Changes residuals, one by one or to zero in a batch, while that lowers |target - y|^2 + `price` times
  /// the bits. `costs`: what each would take in a batch that is not zero; all of them channels x rank, of 1
  /// or 3 channels. Cost: some tens of operations per vertex and sweep, for three channels little more than
  /// for one.
  void improve(uint32_t channels, const float* target, const ResidualCosts* costs,
               const std::vector<BatchCosts>& batches, double price, int32_t* q) const;

 private:
  struct Entry {
    uint32_t rank;
    float value;
  };

  class SparseSum;

  template <Eigen::Index kChannels>
  class Component;

  const VertexOrder& order_;
  std::vector<float> weights_;
  // Columns of (I - W)^-1: what a residual of 1 does to all vertices.
  std::vector<size_t> start_;
  std::vector<Entry> column_;
  std::vector<float> energy_;  ///< sum of the squares of a column
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_JOINT_ROUNDING_H_
