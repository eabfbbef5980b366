// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_SLIDING_SOLVER_H_
#define ANICODEC_CODEC_MASSAGE_SLIDING_SOLVER_H_

#include "codec/massage/rigid_shape.h"
#include "codec/surface/surface.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct SlidingOptions {
  int rounds = 3;
  double tolerance = 1e-2;    ///< stop when the root mean square step is below so many mean edges
  double longest_step = 0.7;  ///< of a vertex in a round, in mean edges at it
};

/// How an iteration ended.
struct Convergence {
  int rounds = 0;
  double step = 0;  ///< root mean square of the last step, in mean edges
  bool converged = false;
};

/// Moves vertices over a surface of the same connectivity until the triangles have the shapes of a
/// reference as rigidly as they can: vertices leave the surface nowhere, slide along its boundary,
/// and stay at its corners (a turn of the boundary by more than 30 degrees) and where it is not
/// manifold. Every round solves for two unknowns a vertex, the move in its tangent plane, and puts
/// the vertices back on the surface by walking. A step that would turn a triangle over is
/// shortened. Serial; may be used from several threads at once.
class SlidingSolver {
 public:
  /// Topology must outlive the solver.
  SlidingSolver(const SurfaceTopology& topology, const Positions& reference);

  /// Moves `v`, which starts on the surface: vertex i at or near its own place. Cost a round: about
  /// 10 passes over the edges.
  Convergence run(const Surface& surface, const SlidingOptions& options, Positions* v) const;

  const RigidShape& shape() const { return shape_; }

  /// Degrees of freedom of every vertex: 2 tangents to move along, 1 along the boundary, 0 pinned.
  const std::vector<uint8_t>& freedom() const { return freedom_; }

 private:
  const SurfaceTopology* topology_;
  RigidShape shape_;
  std::vector<uint8_t> freedom_;
};

/// How many directions each vertex may slide in, by the shape of the reference.
std::vector<uint8_t> sliding_freedom(const SurfaceTopology& topology, const Positions& reference);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_SLIDING_SOLVER_H_
