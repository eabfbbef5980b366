// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_TRANSFER_BLOCK_SYSTEM_H_
#define ANICODEC_CODEC_TRANSFER_BLOCK_SYSTEM_H_

#include "codec/surface/surface.h"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

// The tolerance of the solver in the fits of this room, and the damping added to the diagonal for
// vertices without equations.
inline constexpr double kSolveTolerance = 1e-3, kDamping = 1e-6;

/// A symmetric positive semi-definite system with three unknowns a vertex, whose equations couple a
/// vertex with its neighbours only: a 3 x 3 block for every vertex and edge. The topology must
/// outlive it. Memory: about 600 bytes a vertex.
class BlockSystem {
 public:
  explicit BlockSystem(const SurfaceTopology& topology);

  /// Sets all blocks to zero.
  void clear();

  void add_diagonal(uint32_t i, const Eigen::Matrix3d& block) { diagonal_[i] += block; }

  /// Adds a symmetric block at (i, j) and (j, i), which are neighbours.
  void add_edge(uint32_t i, uint32_t j, const Eigen::Matrix3d& block);

  /// Conjugate gradients from zero, preconditioned by the diagonal blocks, until the residual is
  /// below `tolerance` of the right side or after so many iterations.
  Positions solve(const Positions& right, double tolerance, int most_iterations) const;

 private:
  void apply(const Positions& x, Positions* out) const;

  const SurfaceTopology* topology_;
  std::vector<size_t> first_;              ///< of each vertex in edges_
  std::vector<Eigen::Matrix3d> diagonal_;  ///< a block a vertex
  std::vector<Eigen::Matrix3d> edges_;     ///< in the order of the rings
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_BLOCK_SYSTEM_H_
