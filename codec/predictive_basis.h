// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PREDICTIVE_BASIS_H_
#define ANICODEC_CODEC_PREDICTIVE_BASIS_H_

#include "codec/linear_basis.h"
#include "sdk/predictor.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// How a linear basis is quantised and coded. The three steps share one error budget.
struct PredictiveOptions {
  double step = 0;           ///< of the coefficients, in scene units; must be positive
  double weight_step = 2.2;  ///< of the time weights, relative to step / singular value
  double pose_step = 1.2;    ///< of the pose, relative to step / sqrt(frames)
  double lambda = 0.08;      ///< squared steps a bit of a coefficient is worth
  double weight_lambda = 0.1;
  double rank_share = 0.2;  ///< components stay while energy > this (rows + columns) step^2
  size_t max_components = 65535;
  int neighbours = 16;  ///< 8, 12, 16, 20, 24
  int colours = 1;      ///< 1..kMaxColours; 2 is better for many parts
  uint8_t radius = 12;
  RefitSchedule schedule = RefitSchedule::kDense;
  /// A stream of coefficients ends before each of these components, ascending; none: one stream.
  std::vector<uint32_t> layer_starts;
};

/// A segment as a decoder gets it, with the streams it reads. Ranks count vertices in decoding
/// order, which make_vertex_order() finds from triangles, pose, neighbours and colours.
///
///   x(v, f) = origin + base(v, f) + sum_j u(f, j) * y(v, j) * step
///
/// base: for Base::kAffine the sum of the four AffineFunctions of the pose integers times
/// base_weights(f), for Base::kPose pose_origin + pose_step * pose.
struct PredictiveBasis {
  format::BasisKind kind = format::BasisKind::kEigentrajectories;
  Base base = Base::kAffine;
  uint32_t frames = 0, vertices = 0, components = 0;
  PredictionParameters prediction;
  int neighbours = 0, colours = 0;

  double origin[3] = {};
  double step = 0;

  std::vector<int32_t> pose;   ///< vertices x 3
  double pose_origin[3] = {};  ///< relative to origin
  double pose_step = 0;

  // Time weights are in 1/16: times base_weight_step (scene units) or weight_scale_value().
  double base_weight_step = 0;
  std::vector<int32_t> base_weights;   ///< four functions x 3 axes x frames; none for Base::kPose
  std::vector<uint8_t> weight_scales;  ///< a byte per component
  std::vector<int32_t> weights;        ///< components x weight channels x frames
  std::vector<uint8_t> weight_stream;  ///< base weights, then weights

  std::vector<int32_t> residuals;  ///< components x vertices (ranks) x channels
  std::vector<uint8_t> omega;      ///< a byte per component
  std::vector<std::vector<uint8_t>> coefficient_streams;  ///< one per layer
  std::vector<float> coefficients;  ///< like residuals: what a decoder reconstructs, in steps

  double squared_error = 0;  ///< of all coordinates of the segment, in exact arithmetic

  uint32_t channels() const { return static_cast<uint32_t>(prediction.channels); }

  uint32_t weight_channels() const { return channels() == 1 ? 3 : 1; }

  size_t coefficient_bytes() const;
};

/// Step of the time weights of a component: 2^(-byte / 4).
double weight_scale_value(uint8_t byte);

/// Encodes a segment. triangles: three vertices of the clip each.
/// Throws Error(kInput) where the step is too fine for the clip: a coefficient would leave its
/// range. Same result for any number of threads. Memory beside the clip: 4 numbers of 4 bytes per
/// residual, 800 bytes per vertex (16 neighbours).
PredictiveBasis encode_predictive_basis(const LinearAnalysis& analysis, const LinearBasis& basis,
                                        std::span<const uint32_t> triangles,
                                        const PredictiveOptions& options);

/// Number of components that encode_predictive_basis() keeps at a step, if the basis has as many.
size_t component_count(const LinearBasis& basis, size_t vertices, size_t frames,
                       const PredictiveOptions& options);

/// Energy below which a component is not worth its bits at a step: the `smallest` of
/// LinearAnalysis::basis().
double smallest_energy(format::BasisKind kind, size_t vertices, size_t frames,
                       const PredictiveOptions& options);

/// Positions of one frame as a decoder sees them, in double: vertices x 3. order: of
/// make_vertex_order().
Eigen::MatrixXd decoded_frame(const PredictiveBasis& basis, std::span<const uint32_t> order,
                              size_t frame);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PREDICTIVE_BASIS_H_
