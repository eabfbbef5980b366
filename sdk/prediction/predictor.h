// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Spatial prediction of basis coefficients, decoder's side: integers in, coefficients out, the same
// bits on every platform (spec/09-reconstruction.md).
#ifndef ANICODEC_SDK_PREDICTION_PREDICTOR_H_
#define ANICODEC_SDK_PREDICTION_PREDICTOR_H_

#include "format/memory.h"
#include "format/status.h"
#include "sdk/prediction/prediction_job.h"
#include "sdk/prediction/vertex_order.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Components after which the weights are refitted.
enum class RefitSchedule : uint8_t {
  kNone = 0,    ///< the prior weights throughout
  kSparse = 1,  ///< faster to decode
  kMedium = 2,  ///< smallest files
};
constexpr uint8_t kRefitScheduleCount = 3;

/// Parameters that encoder and decoder of a segment agree on.
struct PredictionParameters {
  int channels = 1;     ///< scalars per vertex and component: 1 (trajectories) or 3 (shapes)
  uint8_t radius = 12;  ///< of the prior's kernel, in mean neighbour distances, 1..255
  RefitSchedule schedule = RefitSchedule::kMedium;
  /// How much the prior heeds who moves alike, in eighths; 0: positions alone make it.
  uint8_t alike = 0;
};

/// Components after which weights are refitted, those after which the prior is renewed among them,
/// ascending; of those before the last of `components`.
Vector<size_t> refits_of(const PredictionParameters& parameters, size_t components);

/// The components after which the prior is renewed.
Vector<size_t> renewals_of(const PredictionParameters& parameters, size_t components);

/// Weight of a component's samples in the refit, from its byte: 2^((byte - 128) / 4), rounded.
float omega_value(uint8_t byte);

/// Squared weight of motion in a renewed prior, from its byte: (byte / 8)^2.
constexpr float alike_value(uint8_t byte) {
  return static_cast<float>(byte * byte) / 64.0f;
}

/// The byte for a component with mean squared residual `energy`, in squared steps. For the encoder.
uint8_t omega_byte(double energy);

/// kArgument: a number of neighbours or a parameter that no decoder accepts.
Status check_prediction(const VertexOrder& order, const PredictionParameters& parameters);

/// Positions (vertex x 3) as floats in decoding order.
void ranked_positions(const VertexOrder& order, const int32_t* positions, Vector<float>* out);

/// Floats of one vertex in the output: samples, rounded up.
constexpr size_t coefficient_stride(size_t samples) {
  return (samples + 7) / 8 * 8;
}

/// Floats of the whole output; the last row is scratch.
constexpr size_t coefficient_buffer_size(size_t vertices, size_t samples) {
  return (vertices + 1) * coefficient_stride(samples);
}

/// The decoded integers of a segment: components x channels x vertices in decoding order, any
/// values. The first wide_components are 32-bit, the others 16-bit.
struct PredictionResiduals {
  size_t components = 0;
  size_t wide_components = 0;
  const int32_t* wide = nullptr;
  const int16_t* narrow = nullptr;
  const uint8_t* omega = nullptr;  ///< one byte per component
};

/// Statistics that vertices have learnt: learnt_floats() x ranks. It must outlive who uses it.
struct PredictionLearning {
  const Vector<float>* continued = nullptr;  ///< of the segment that this one continues, or null
  Vector<float>* learnt = nullptr;           ///< receives that of this one, if not null
};

/// Reconstructs the coefficients of one segment from the decoded integers.
///
/// Call init() once, then run() for all ranks in ascending order of levels. Ranges within one level
/// do not depend on each other and may run at the same time. Allocates 12 bytes per vertex.
class CoefficientReconstruction {
 public:
  /// @param order       from make_vertex_order() with 8, 12, 16, 20 or 24 neighbours
  /// @param positions   reference positions by vertex, x 3, as the order was made from
  /// @param residuals   the decoded integers
  /// @param y           coefficient_buffer_size() floats: receives the coefficients in steps, by
  /// rank order, the integers and y must outlive this object.
  /// @param learning    of a segment that learns from another one, or for another one
  /// @return kArgument: a parameter out of range
  Status init(const VertexOrder& order, const int32_t* positions,
              const PredictionParameters& parameters, const PredictionResiduals& residuals,
              float* y, const PredictionLearning& learning = {});

  /// Ranks [first, last) of one level. Sets the floating-point environment it needs and restores
  /// the caller's.
  void run(size_t first, size_t last) const;

 private:
  PredictionJob job_;
  const VertexOrder* order_ = nullptr;
  Vector<float> positions_;
  Vector<float> omega_;
  Vector<size_t> refits_, renewals_;  ///< by samples
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_PREDICTOR_H_
