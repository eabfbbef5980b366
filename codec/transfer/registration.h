// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_TRANSFER_REGISTRATION_H_
#define ANICODEC_CODEC_TRANSFER_REGISTRATION_H_

#include "codec/massage/correspondence.h"
#include "codec/massage/rigid_shape.h"
#include "codec/massage/sliding_solver.h"
#include "codec/surface/surface.h"
#include "codec/transfer/block_system.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// A vertex that is to come to a point.
struct Landmark {
  uint32_t vertex = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

struct RegistrationOptions {
  double first_stiffness = 5;    ///< of the shape against the distance, at first
  double last_stiffness = 0.05;  ///< and at last; geometrically between
  int rounds = 14;
  /// Share of the distance along the surface that counts, halved at a stiffness of 1 and less at
  /// smaller ones: it draws large motions together early. Across the surface the share is 1.
  double point_share = 0.1;
  bool trust_near = true;  ///< far correspondences count less
  bool centres = false;    ///< triangle centres are drawn to the surface as well
  std::vector<Landmark> landmarks;
  double landmark_weight = 10;
};

struct RegistrationReport {
  Convergence convergence;  ///< of the last round; converged: a step below a hundredth of an edge
  Residuals residuals;      ///< after the last round
};

/// Deforms a mesh onto a surface of any connectivity, as rigidly as it can (thesis section 3.3.4):
/// minimises
///   stiffness * (energy of RigidShape) + mean over correspondences of the squared distance
/// in units of a vertex, with distances across the surface (point to plane), and a small share
/// along it. The stiffness falls from round to round. A step that would turn a triangle over is
/// shortened.
class Registration {
 public:
  /// `shape` has the connectivity of `mesh`; both must outlive it.
  Registration(const SurfaceTopology& mesh, const RigidShape& shape);

  /// Moves `v`. The surface has an index. Cost: a round is about 15 queries a vertex and 100 passes
  /// over the edges.
  RegistrationReport run(const Surface& surface, const RegistrationOptions& options, Positions* v);

  /// Moves `v` to where the landmarks are at their places, nearly, and the rest follows as rigidly
  /// as it can, wherever a surface may be. Triangles may turn over on the way. Cost: 20 times 100
  /// passes over the edges.
  void pose(const std::vector<Landmark>& landmarks, Positions* v);

 private:
  void add_shape(double stiffness);
  void add_landmarks(const std::vector<Landmark>& landmarks, double weight, const Positions& v,
                     Positions* right);
  void add_correspondences(const std::vector<Correspondence>& list, double along_share,
                           const Positions& v, Positions* right);

  const SurfaceTopology* mesh_;
  const RigidShape* shape_;
  BlockSystem system_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_REGISTRATION_H_
