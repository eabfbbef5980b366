// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_INTERPOLATION_EDGE_REFINEMENT_H_
#define ANICODEC_CODEC_INTERPOLATION_EDGE_REFINEMENT_H_

#include "codec/surface/edge_network.h"

#include <cstdint>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace anicodec {

/// Moves vertices so that edge lengths and dihedral angles come closer to given ones, by
/// Gauss-Newton steps on the discrete shell energy (Fröhlich and Botsch, "Example-Driven
/// Deformations Based on Discrete Shells", 2011)
///
///   sum over edges of (l - l*)^2 / l*^2 + sum over hinges of l^2 / A (theta - theta*)^2
///
/// l and A, the area of both triangles, being those of the target. A good start is needed: an
/// interpolation of the same meshes. Degenerate triangles' hinges and edges without length do not
/// count.
class EdgeRefinement {
 public:
  /// The network must outlive this object. Finds the order of elimination, which serves all steps.
  explicit EdgeRefinement(const EdgeNetwork& network);

  /// Takes up to `steps` steps, each shortened until the energy falls; stops when none does.
  /// Returns the energy reached. Cost per step: that of factoring a matrix of 3 rows per vertex.
  double refine(const EdgeShape& target, int steps, Points& x);

  double energy(const EdgeShape& target, const Points& x);

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Adds residual and gradient of one term to matrix and right-hand side.
  template <size_t kVertices>
  void add(const uint32_t (&vertices)[kVertices], const Eigen::Vector3d (&gradient)[kVertices],
           double residual, double weight, Eigen::VectorXd& right);
  void assemble(const EdgeShape& target, const Points& x, Eigen::VectorXd& right);
  void set_weights(const EdgeShape& target);
  double weighted_energy(const EdgeShape& target, const Points& x) const;
  double* block(uint32_t row, uint32_t column);

  const EdgeNetwork& network_;
  Eigen::VectorXd length_weights_, angle_weights_;
  Matrix matrix_;                                  ///< lower triangle, 3 x 3 blocks
  std::vector<uint32_t> first_block_, block_row_;  ///< blocks below the diagonal of each column
  Eigen::SimplicialLDLT<Matrix> solver_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_INTERPOLATION_EDGE_REFINEMENT_H_
