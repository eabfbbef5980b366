// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Spatial prediction of basis coefficients, encoder's side.
#ifndef ANICODEC_SDK_PREDICTION_ENCODER_PREDICTOR_H_
#define ANICODEC_SDK_PREDICTION_ENCODER_PREDICTOR_H_

#include "format/memory.h"
#include "format/status.h"
#include "sdk/prediction/prediction_job.h"
#include "sdk/prediction/predictor.h"
#include "sdk/prediction/vertex_order.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Predicts one component after the other, with the numbers that CoefficientReconstruction
/// computes, so that the encoder quantises against what a decoder will see. It lives beside the
/// decoder to share its arithmetic.
///
///   for each component: for each rank: for each channel: predict(), then commit() its integer;
///                       update(0, block_count(), omega); next_component().
///
/// Memory: 4 (m(m+1)/2 + 3m + channels + 3) bytes per vertex: 800 for m = 16; 36 channels more if
/// the prior is renewed.
class EncoderPredictor {
 public:
  /// order must outlive this object. Arguments and errors as for CoefficientReconstruction::init().
  /// continued: see PredictionLearning.
  Status init(const VertexOrder& order, const int32_t* positions,
              const PredictionParameters& parameters, size_t components,
              const Vector<float>* continued = nullptr);

  /// Prediction of one channel of the current component, in steps: rounded to 1/64. All neighbours
  /// of the rank must be committed.
  float predict(size_t rank, int channel) const;

  /// Sets and returns the coefficient that a decoder reconstructs from q.
  float commit(size_t rank, int channel, float prediction, int32_t q);

  /// The weights of the current component: rank x neighbour_count. They change with refits alone.
  void weights(float* out) const;

  /// Whether update() of the current component refits, so that the next one has other weights.
  bool refits() const;

  /// Coefficients of the current component, by rank.
  const float* coefficients(int channel) const {
    return y_.data() + static_cast<size_t>(channel) * (vertices_ + 1);
  }

  /// Learns from the current component. Blocks may be updated at the same time; all of them must
  /// be, with the same omega, before next_component().
  size_t block_count() const { return block_count_; }

  void update(size_t first_block, size_t last_block, uint8_t omega);

  void next_component();

 private:
  EncoderJob job(uint8_t omega);

  size_t vertices_ = 0, components_ = 0, component_ = 0;
  size_t block_count_ = 0, lanes_ = 1, neighbour_count_ = 0;
  PredictionParameters parameters_;
  const VertexOrder* order_ = nullptr;
  Vector<size_t> refits_, renewals_;
  Vector<float> positions_, state_, y_;
  Vector<float> earlier_;  ///< the components before, as y_, as long as a prior needs them
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_ENCODER_PREDICTOR_H_
