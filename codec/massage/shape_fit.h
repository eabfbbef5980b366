// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_SHAPE_FIT_H_
#define ANICODEC_CODEC_MASSAGE_SHAPE_FIT_H_

#include "codec/massage/correspondence.h"
#include "codec/massage/shape_weights.h"
#include "codec/massage/sliding_solver.h"
#include "codec/surface/surface.h"

#include <cstdint>
#include <memory>

#include <Eigen/SparseCore>

namespace anicodec {

struct ShapeFitOptions {
  double lambda = 0.5;  ///< trade-off, in (0, 1): 0 shape alone, 1 distance alone
  int rounds = 10;
  double tolerance = 1e-2;  ///< stop when the root mean square step is below so many mean edges
  bool centres = false;     ///< triangle centres are drawn to the surface as well
  /// 0: least squares. Else Lawson's reweighting for the largest distance, weights times
  /// (distance / RMS)^exponent each round; the round of the smallest maximum counts.
  double lawson = 0;
};

struct ShapeFitReport {
  Convergence convergence;
  Residuals residuals;  ///< before the last round
};

/// Mesh Massage's combined optimisation (thesis section 3.1.3): minimises
///   (1 - lambda)/m |A v - delta|^2 + lambda mean |B v - c|^2
/// over the vertices v of a mesh, round by round. A is the shape matrix; delta the part of A v
/// along the present normals, so that only the tangential part is asked for and the surface does
/// not shrink. The rows of B are the correspondences, of which both directions count alike; they
/// are found anew by the spatial index in the first and every fourth round. The pattern of the
/// matrix never changes: its symbolic factorisation is kept for all runs; where few iterations do,
/// and for large systems, conjugate gradients solve it.
class ShapeFit {
 public:
  /// All must outlive the fitter. `shape` is that of shape_matrix().
  ShapeFit(const SurfaceTopology& mesh, const RowMatrix& shape);
  ~ShapeFit();

  /// Moves `v`. The surface has an index. Throws Error(kInput) if a system cannot be solved.
  ShapeFitReport run(const Surface& surface, const ShapeFitOptions& options, Positions* v);

 private:
  class FitIteration;
  class Solver;

  const SurfaceTopology* mesh_;
  const RowMatrix* shape_;
  Eigen::SparseMatrix<double> square_;  ///< A^T A
  std::unique_ptr<Solver> solver_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_SHAPE_FIT_H_
