// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_INTERPOLATION_DEFORMATION_GRADIENTS_H_
#define ANICODEC_CODEC_INTERPOLATION_DEFORMATION_GRADIENTS_H_

#include "codec/surface/edge_network.h"
#include "sdk/msgi/face_graph.h"
#include "sdk/msgi/sparse_ldlt.h"

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// How the logarithms of the rotations of neighbouring triangles are made to agree, which one alone
/// knows but for full turns (thesis section 4.1).
enum class RotationTracking {
  kNone,               ///< the principal logarithm of every triangle
  kBreadthFirst,       ///< each takes the turn nearest to the triangle it was reached from
  kPrioritized,        ///< PML: the same, first where the logarithms differ least
  kPrioritizedNormals  ///< PMLN: the angles between the normals in both poses count too
};

/// A logarithm of the rotation as a vector, axis times angle: of all that differ from `principal`
/// by full turns about its axis the one nearest to `wanted`.
Eigen::Vector3d nearest_logarithm(const Eigen::Vector3d& principal, const Eigen::Vector3d& wanted);

/// Polar decomposition (thesis appendix A.1): m = exp(turn) stretch, stretch symmetric. A mirrored
/// m has a negative eigenvalue in its stretch.
struct RotationAndStretch {
  Eigen::Vector3d turn;  ///< the principal logarithm
  Eigen::Matrix3d stretch;
};

RotationAndStretch decompose(const Eigen::Matrix3d& m);

/// exp(turn) as a matrix (thesis appendix A.2).
Eigen::Matrix3d exponential(const Eigen::Vector3d& turn);

/// The gradient of every triangle's deformation from the first input, the normal scaled by the
/// square root of the area (Sumner and Popović 2004; thesis appendix A), with its rotation's
/// logarithm and its stretch apart, and positions from gradients by Poisson's equation.
class DeformationGradients {
 public:
  /// Positions of `reference` are what the gradients refer to. Cost: O(n log n) and the
  /// factorisation of one matrix over the vertices. Throws Error(kInput) when the mesh has no
  /// triangle with an area.
  DeformationGradients(const EdgeNetwork& network, const Points& reference);

  struct Gradients {
    std::vector<Eigen::Vector3d> turns;      ///< per triangle
    std::vector<Eigen::Matrix3d> stretches;  ///< per triangle
  };

  Gradients measure(const Points& x, RotationTracking tracking) const;

  /// The mesh that comes closest to the gradients, area weighted. `guide` places each component (by
  /// its centroid) and what no triangle of some area holds.
  Points solve(std::span<const Eigen::Matrix3d> gradients, const Points& guide) const;

  size_t triangle_count() const { return areas_.size(); }

  /// Areas of the triangles in the reference; 0 for a degenerate one.
  const std::vector<double>& areas() const { return areas_; }

 private:
  Eigen::Matrix3d frame(const Points& x, size_t triangle) const;
  Eigen::Vector3d normal(const Points& x, size_t triangle) const;
  void track(const Points& x, RotationTracking tracking, Gradients& gradients) const;
  void track_component(const Points& x, RotationTracking tracking, uint32_t seed,
                       std::vector<char>& done, Gradients& gradients) const;

  FaceGraph graph_;
  Points reference_;
  std::vector<double> areas_;
  std::vector<Eigen::Matrix3d> inverse_frames_;  ///< of the reference; zero where degenerate
  std::vector<Eigen::Matrix3d> hats_;  ///< per triangle: gradients of the corners' hat functions
  std::vector<double> edge_weights_;   ///< what holds the mesh where triangles do not
  SparseLdlt system_;
};

/// Interpolation by them: logarithms and stretches linearly.
class GradientInterpolation {
 public:
  GradientInterpolation(const EdgeNetwork& network, std::span<const Points> inputs,
                        RotationTracking tracking);

  /// The mesh at the weights, one per input, which sum to one.
  Points evaluate(std::span<const double> weights) const;

  /// The quantities of an input that are blended.
  const DeformationGradients::Gradients& measured(size_t input) const { return measured_[input]; }

  const std::vector<double>& areas() const { return gradients_.areas(); }

 private:
  DeformationGradients gradients_;
  std::vector<Points> inputs_;
  std::vector<DeformationGradients::Gradients> measured_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_INTERPOLATION_DEFORMATION_GRADIENTS_H_
