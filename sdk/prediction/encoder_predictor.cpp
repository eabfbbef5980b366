// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/prediction/encoder_predictor.h"

#include "sdk/base/float_control.h"
#include "sdk/prediction/prediction_job.h"
#include "sdk/prediction/prediction_rounding.h"

#include <algorithm>

namespace anicodec {
namespace {

const EncoderKernels& encoder_kernels() {
#if defined(ANICODEC_PREDICTION_AVX2)
  static const EncoderKernels& best =
      fastest_kernels(kEncoderKernelsAvx512, kEncoderKernelsAvx2, kEncoderKernelsPortable);
  return best;
#else
  return kEncoderKernelsPortable;
#endif
}

}  // namespace

Status EncoderPredictor::init(const VertexOrder& order, const int32_t* positions,
                              const PredictionParameters& parameters, size_t components,
                              const Vector<float>* continued) {
  if (Status s = check_prediction(order, parameters); s != Status::kOk)
    return s;
  order_ = &order;
  parameters_ = parameters;
  vertices_ = order.vertex_count();
  components_ = components;
  component_ = 0;
  neighbour_count_ = static_cast<size_t>(order.neighbour_count);
  lanes_ = encoder_kernels().lanes;
  block_count_ = (vertices_ + lanes_ - 1) / lanes_;
  refits_ = refits_of(parameters, components);
  renewals_ = renewals_of(parameters, components);
  earlier_.clear();
  ranked_positions(order, positions, &positions_);
  state_.resize(block_count_ * encoder_block_rows(neighbour_count_) * lanes_);
  y_.assign(static_cast<size_t>(parameters.channels) * (vertices_ + 1), 0.0f);
  const FloatControl control;
  EncoderJob start = job(0);
  start.continued = continued ? continued->data() : nullptr;
  encoder_kernels().start_blocks(start, 0, block_count_);
  return Status::kOk;
}

EncoderJob EncoderPredictor::job(uint8_t omega) {
  EncoderJob j;
  j.neighbour_count = order_->neighbour_count;
  j.vertices = vertices_;
  j.channels = static_cast<size_t>(parameters_.channels);
  j.neighbours = order_->neighbours.data();
  j.positions = positions_.data();
  j.radius = parameters_.radius;
  j.state = state_.data();
  j.y = y_.data();
  j.omega = omega_value(omega);
  j.alike = alike_value(parameters_.alike);
  return j;
}

float EncoderPredictor::predict(size_t rank, int channel) const {
  const float* weights =
      state_.data() + rank / lanes_ * lanes_ * encoder_block_rows(neighbour_count_) + rank % lanes_;
  const float* y = coefficients(channel);
  const int32_t* neighbours = order_->neighbours.data() + rank * neighbour_count_;
  float p = 0;
  for (size_t a = 0; a < neighbour_count_; ++a) {
    const int32_t b = neighbours[a];
    p += weights[a * lanes_] * y[b < 0 ? vertices_ : static_cast<size_t>(b)];
  }
  return rounded_prediction(p);
}

void EncoderPredictor::weights(float* out) const {
  for (size_t rank = 0; rank < vertices_; ++rank) {
    const float* from = state_.data() +
                        rank / lanes_ * lanes_ * encoder_block_rows(neighbour_count_) +
                        rank % lanes_;
    for (size_t a = 0; a < neighbour_count_; ++a)
      *out++ = from[a * lanes_];
  }
}

bool EncoderPredictor::refits() const {
  return std::binary_search(refits_.begin(), refits_.end(), component_);
}

float EncoderPredictor::commit(size_t rank, int channel, float prediction, int32_t q) {
  const float y = limited_coefficient(prediction + static_cast<float>(q));
  y_[static_cast<size_t>(channel) * (vertices_ + 1) + rank] = y;
  return y;
}

void EncoderPredictor::update(size_t first_block, size_t last_block, uint8_t omega) {
  // Beyond the last refit nothing is learnt any more.
  if (refits_.empty() || component_ > refits_.back())
    return;
  EncoderJob j = job(omega);
  j.refit = refits();
  j.renew = std::binary_search(renewals_.begin(), renewals_.end(), component_);
  j.earlier = earlier_.data();
  j.earlier_samples = component_ * j.channels;
  const FloatControl control;
  encoder_kernels().update_blocks(j, first_block, last_block);
}

void EncoderPredictor::next_component() {
  if (!renewals_.empty() && component_ < renewals_.back())
    earlier_.insert(earlier_.end(), y_.begin(), y_.end());
  ++component_;
}

}  // namespace anicodec
