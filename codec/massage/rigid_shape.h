// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_RIGID_SHAPE_H_
#define ANICODEC_CODEC_MASSAGE_RIGID_SHAPE_H_

#include "codec/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// The shape of a reference mesh as rigid rings (Sorkine and Alexa, "As-rigid-as-possible surface
/// modeling", SGP 2007): the energy of positions v is the sum over edges of
/// c_ij |(v_i - v_j) - (R_i + R_j)/2 (p_i - p_j)|^2, with p the reference, R_i the best rotation of
/// the ring of i, and c_ij its cotangent weights, clamped to [0.05, 50].
class RigidShape {
 public:
  struct Spoke {
    uint32_t end;
    double weight;         ///< c_ij
    Eigen::Vector3d edge;  ///< p_i - p_j
  };

  RigidShape(const SurfaceTopology& topology, const Positions& reference);

  uint32_t vertex_count() const { return static_cast<uint32_t>(first_.size() - 1); }

  std::span<const Spoke> spokes(uint32_t i) const {
    return {spokes_.data() + first_[i], first_[i + 1] - first_[i]};
  }

  /// Sum of c_ij over the spokes of each vertex.
  const Eigen::VectorXd& total_weight() const { return total_; }

  /// Turns every rotation to the best one for the positions; the old ones settle what is open.
  void update_rotations(const Positions& v, std::vector<Eigen::Matrix3d>* rotations) const;

  /// Half the gradient of the energy in v with the rotations fixed: sum_j c_ij ((v_i - v_j) -
  /// (R_i + R_j)/2 (p_i - p_j)).
  Positions half_gradient(const Positions& v, std::span<const Eigen::Matrix3d> rotations) const;

  /// out_i = sum_j c_ij (x_i - x_j).
  void apply_laplacian(const Positions& x, Positions* out) const;

 private:
  std::vector<size_t> first_;
  std::vector<Spoke> spokes_;
  Eigen::VectorXd total_;
};

/// The cotangents of the angles opposite to the edges, half their sum, each cotangent at most 50
/// and the sum at least `least`; in the order of edges().
std::vector<double> cotangent_weights(const SurfaceTopology& topology, const Positions& positions,
                                      double least);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_RIGID_SHAPE_H_
