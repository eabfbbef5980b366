// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/coefficient_encoder.h"

#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"
#include "sdk/segment/learnt_segment.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr int kFewestFractionBits = 4;  // with fewer, residency would add to the error

/// Rounds a residual with the cost of its candidates in mind. @pre |residual| < kCoefficientLimit - 1
int32_t rounded(CoefficientCosts& model, uint32_t v, uint32_t c, double residual, double lambda) {
  double magnitude = std::abs(residual);
  auto q = static_cast<int32_t>(magnitude + 0.5);
  if (q == 0 || lambda <= 0 || q > 200)
    return residual < 0 ? -q : q;
  const ResidualCosts costs = model.costs(v, c);
  int32_t best = 0, sign = residual < 0 ? -1 : 1;
  double least = 0;
  for (int32_t candidate = q; candidate >= (q <= 2 ? 0 : q - 1); --candidate) {
    double d = magnitude - candidate;
    double cost = d * d + lambda * static_cast<double>(bits_of(costs, sign * candidate));
    if (candidate == q || cost < least) {
      least = cost;
      best = candidate;
    }
  }
  return sign * best;
}

}  // namespace

VertexOrder coefficient_order(const LinearSettings& settings, const MeshLayout& layout,
                              const Vector<int32_t>& pose, const uint8_t* regions) {
  VertexOrder order;
  MeshGraph graph;
  const Vector<uint32_t>& triangles = layout.topology.triangles;
  if (graph.init(triangles.data(), triangles.size() / 3, pose.size() / 3) != Status::kOk ||
      make_vertex_order(graph, pose.data(), settings.neighbours, settings.passes_per_level, &order,
                        regions) != Status::kOk)
    throw Error(ErrorKind::kInternal, "the vertex order cannot be made");
  return order;
}

CoefficientEncoder::CoefficientEncoder(const LinearSettings& settings, VertexOrder order,
                                       const Vector<int32_t>& pose, Coefficients target,
                                       uint32_t channels, const LearntSegment* continued)
    : lambda_(settings.lambda),
      joint_lambda_(settings.joint_lambda),
      target_(std::move(target)),
      decoded_(target_.rows(), target_.cols()),
      channels_(channels),
      order_(std::move(order)),
      model_(first_model(continued)),
      joint_(order_),
      layers_anew_(settings.layers_anew),
      component_(size_t{ranks()} * channels),
      residuals_(size_t{ranks()} * channels) {
  PredictionParameters prediction;
  prediction.channels = static_cast<int>(channels);
  prediction.radius = settings.radius;
  prediction.schedule = settings.schedule;
  prediction.alike = settings.alike;
  if (predictor_.init(order_, pose.data(), prediction,
                      static_cast<size_t>(target_.cols()) / channels,
                      continued ? &continued->prediction : nullptr) != Status::kOk)
    throw Error(ErrorKind::kInternal, "the predictor refuses its parameters");
}

CoefficientCosts CoefficientEncoder::first_model(const LearntSegment* continued) const {
  if (continued) {
    CoefficientModel model = continued->coefficients[0];
    model.continue_with(order_.neighbours.data(), order_.level_start);
    return CoefficientCosts(std::move(model));
  }
  return {channels_, order_.neighbours.data(), static_cast<uint32_t>(order_.neighbour_count),
          order_.level_start};
}

Bytes CoefficientEncoder::finish_layer() {
  write_chosen();
  Bytes bytes = encoder_.finish();
  encoder_ = RansEncoder();
  if (layers_anew_)
    model_ = first_model(nullptr);
  return bytes;
}

void CoefficientEncoder::take_decoded(DecodedBasis* to) && {
  const auto samples = static_cast<size_t>(decoded_.cols());
  const size_t stride = coefficient_stride(samples);
  target_.resize(0, 0);  // what follows takes as much memory
  predictor_ = EncoderPredictor();
  to->coefficients.resize(coefficient_buffer_size(order_.vertex_count(), samples));
  for (size_t i = 0; i < order_.vertex_count(); ++i)
    std::copy_n(decoded_.row(order_.order[i]).data(), samples,
                to->coefficients.data() + i * stride);
  to->order = std::move(order_.order);
}

/// Predicts, chooses and codes residual by residual.
template <class Coder, class Choose>
bool CoefficientEncoder::pass(CoefficientCosts& model, Coder& coder, const Choose& choose) {
  model.begin_component();
  for (uint32_t i = 0; i < ranks(); ++i) {
    for (uint32_t c = 0; c < channels_; ++c) {
      const float prediction = predictor_.predict(i, static_cast<int>(c));
      const std::optional<int32_t> q = choose(i, c, prediction);
      if (!q)
        return false;
      model.code(coder, i, c, *q);
      predictor_.commit(i, static_cast<int>(c), prediction, *q);
      residuals_[place(i, c)] = *q;
    }
  }
  model.end_component();
  return true;
}

/// The residual that is best by itself; nothing if it is too large.
std::optional<int32_t> CoefficientEncoder::nearest(CoefficientCosts& model, uint32_t i, uint32_t c,
                                                   float prediction) const {
  const double residual =
      static_cast<double>(component_[place(i, c)]) - static_cast<double>(prediction);
  if (std::abs(residual) >= kCoefficientLimit - 1)
    return std::nullopt;
  return rounded(model, i, c, residual, lambda_);
}

/// Chooses the residuals of a component as a whole, what they cost by rehearsals with copies of the
/// model. Writes the component before on the way.
bool CoefficientEncoder::round_together() {
  std::vector<float> weights;
  if (new_weights_) {
    weights.resize(order_.neighbours.size());
    predictor_.weights(weights.data());
  }
  std::vector<ResidualCosts> costs(residuals_.size());
  Rehearsal rehearsal;
  bool is_coded = false;
  // The first rehearsal does not need what the weights become. Isolated, so that a thread that waits
  // does not begin another trial.
  isolated([&] {
    parallel_invoke(
        [&] {
          write_chosen();
          rehearsed_ = model_;
          is_coded = pass(*rehearsed_, rehearsal, [&](uint32_t i, uint32_t c, float prediction) {
            costs[place(i, c)] = rehearsed_->costs(i, c);
            return nearest(*rehearsed_, i, c, prediction);
          });
        },
        [&] {
          if (new_weights_)
            joint_.set_weights(std::move(weights));
        });
  });
  if (!is_coded)
    return false;
  const auto improve = [&] {
    joint_.improve(channels_, component_.data(), costs.data(), rehearsed_->batches(), joint_lambda_,
                   residuals_.data());
  };
  improve();
  rehearsed_ = model_;
  rehearsed_->begin_component();
  for (uint32_t i = 0; i < ranks(); ++i) {
    for (uint32_t c = 0; c < channels_; ++c) {
      costs[place(i, c)] = rehearsed_->costs(i, c);
      rehearsed_->code(rehearsal, i, c, residuals_[place(i, c)]);
    }
  }
  rehearsed_->end_component();
  improve();
  return true;
}

/// Takes the residuals over as a decoder sees them.
bool CoefficientEncoder::commit_chosen() {
  for (uint32_t i = 0; i < ranks(); ++i) {
    for (uint32_t c = 0; c < channels_; ++c) {
      const auto channel = static_cast<int>(c);
      const int32_t q = residuals_[place(i, c)];
      if (std::abs(q) >= kCoefficientLimit)
        return false;
      predictor_.commit(i, channel, predictor_.predict(i, channel), q);
    }
  }
  return true;
}

/// Writes the component that waits for it, if one does.
void CoefficientEncoder::write_chosen() {
  if (chosen_.empty())
    return;
  model_.code_component(encoder_, chosen_.data());
  chosen_.clear();
}

/// Rounds and writes a component residual by residual.
bool CoefficientEncoder::round_each() {
  return pass(model_, encoder_, [&](uint32_t i, uint32_t c, float prediction) {
    return nearest(model_, i, c, prediction);
  });
}

std::optional<CoefficientEncoder::Component> CoefficientEncoder::code(size_t j) {
  const uint32_t n = ranks();
  const auto column = [&](uint32_t c) { return static_cast<Index>(j * channels_ + c); };
  for (uint32_t c = 0; c < channels_; ++c)
    for (uint32_t i = 0; i < n; ++i)
      component_[place(i, c)] = target_(order_.order[i], column(c));
  const bool together = joint_lambda_ > 0;
  if (together ? !round_together() || !commit_chosen() : !round_each())
    return std::nullopt;
  double energy = 0, largest = 0, largest_residual = 0;
  for (uint32_t c = 0; c < channels_; ++c) {
    const float* y = predictor_.coefficients(static_cast<int>(c));
    for (uint32_t i = 0; i < n; ++i) {
      const auto q = static_cast<double>(residuals_[place(i, c)]);
      energy += q * q;
      largest_residual = std::max(largest_residual, std::abs(q));
      largest = std::max(largest, std::abs(static_cast<double>(y[i])));
      decoded_(order_.order[i], column(c)) = y[i];
    }
  }
  Component component;
  component.wide = largest * (1 << kFewestFractionBits) > INT16_MAX || largest_residual > INT16_MAX;
  component.omega = omega_byte(energy / (static_cast<double>(n) * channels_));
  parallel_for(size_t{0}, predictor_.block_count(),
               [&](size_t b) { predictor_.update(b, b + 1, component.omega); });
  new_weights_ = predictor_.refits();
  predictor_.next_component();
  if (together)
    chosen_ = residuals_;
  return component;
}

}  // namespace anicodec
