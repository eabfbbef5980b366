// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_LINEAR_SETTINGS_H_
#define ANICODEC_CODEC_SEGMENT_LINEAR_SETTINGS_H_

#include "format/coding/time_weights.h"
#include "sdk/prediction/predictor.h"
#include "sdk/segment/linear_segment.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace anicodec {

/// How finely a linear basis is coded, all steps tied to that of the coefficients.
struct LinearSettings {
  double step = 1;             ///< of the coefficients, scene units
  double weight_factor = 2.4;  ///< step of time weights: weight_factor * step / sigma
  double pose_factor = 2;      ///< step of the pose: pose_factor * step / sqrt(frames)
  double lambda = 0.08;        ///< squared steps that a bit is worth when rounding coefficients
  double weight_lambda = 0.1;  ///< the same for time weights
  uint32_t weight_predictors = (1U << kWeightPredictors) - 1;  ///< a bit for each that may be used
  std::vector<uint8_t> run_steps;  ///< of each clip, LinearParameters::run_steps
  /// Not 0: the coefficients of a component are rounded together, at so many squared steps to a
  /// bit, instead of one by one at `lambda`.
  double joint_lambda = 0;
  bool refit_weights = false;  ///< code the weights that are best for the decoded coefficients
  /// Components with less energy per scalar, in squared steps, are left out.
  double rank_factor = 0.2;
  /// Exact numbers of components, one for each region; empty: as many as rank_factor says.
  std::vector<size_t> components;
  uint8_t neighbours = 16;
  uint8_t passes_per_level = 1;
  uint8_t radius = 12;
  RefitSchedule schedule = RefitSchedule::kMedium;
  uint8_t alike = 0;         ///< PredictionParameters::alike
  bool layers_anew = false;  ///< LinearParameters::layers_anew
  uint32_t layers = 1;       ///< parts that the components are stored in
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_LINEAR_SETTINGS_H_
