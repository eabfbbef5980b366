// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_LINEAR_SEGMENT_H_
#define ANICODEC_SDK_SEGMENT_LINEAR_SEGMENT_H_

#include "format/coding/time_weights.h"
#include "format/memory.h"
#include "sdk/prediction/predictor.h"
#include "sdk/segment/segment.h"

#include <cstdint>

namespace anicodec {

/// Parameters of a segment of eigenshapes or eigentrajectories (spec/09-reconstruction.md).
///
///   x(v, f) = base(v, f) + sum_j u(f, j) * basis_step * y(j, v)
///
/// y are the coefficients in steps, in 1/64, predicted and decoded; u = weight / 16 * weight_step /
/// sigma(j) with integer weights. The base is the reference pose, or in every frame an affine image
/// of it, whose twelve numbers per frame are four more components of sigma 1. Regions of the surface
/// have weights and bases of their own.
struct LinearParameters {
  bool affine = true;  ///< the base moves with the frames
  double basis_step = 1;
  double weight_step = 1;
  uint8_t neighbours = 16;  ///< m, see VertexOrder
  uint8_t colours = 1;
  uint8_t radius = 12;
  RefitSchedule schedule = RefitSchedule::kMedium;
  bool layers_anew = false;  ///< the entropy coders' models begin anew with each layer
  uint8_t alike = 0;         ///< PredictionParameters::alike
  /// For each run of frames of a clip: its weights have weight_step * 2^(run_steps / 8). Empty:
  /// all have weight_step.
  Vector<uint8_t> run_steps;

  /// How many of the components each region has weights of; empty: there is one, with all.
  Vector<uint32_t> region_components;

  uint32_t regions() const {
    return region_components.empty() ? 1 : static_cast<uint32_t>(region_components.size());
  }

  /// Whether a region has weights of a component.
  bool has_weights(uint32_t region, size_t component) const {
    return region_components.empty() || component < region_components[region];
  }

  /// Per component, in the order of the file.
  Vector<uint8_t> omega;  ///< see omega_value()
  /// Components x regions, in eighths of an octave: sigma(j) = 2^(sigma / 8).
  Vector<int32_t> sigma;

  Bytes write() const;
  Status read(ByteView bytes, uint32_t components, size_t runs, uint32_t regions);

  /// 2^(eighths / 8).
  static double sigma_value(int32_t eighths);
  /// The eighths that come nearest.
  static int32_t sigma_eighths(double sigma);
};

/// Largest number of fraction bits with which coefficients stay resident.
inline constexpr int kFractionBits = 6;

Status open_linear_segment(const SegmentRecord& record, const SegmentContext& context,
                           DecodedIntegers& integers, Segment* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_LINEAR_SEGMENT_H_
