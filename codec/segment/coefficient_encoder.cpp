// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/coefficient_encoder.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr int kFewestFractionBits = 4;  // with fewer, residency would add to the error
constexpr double kBitsPerUnit = 65536;  // of BitCounter

/// Lets a model learn as from coding, and writes nothing.
struct Rehearsal {
  static constexpr bool kAdapts = true;
  static constexpr bool kDecodes = false;

  bool bit(uint32_t, bool value) { return value; }

  bool bit(AdaptiveBit& model, bool value) {
    model.update(value);
    return value;
  }

  uint32_t raw(int, uint32_t value) { return value; }
};

/// Rounds a residual with the cost of its candidates in mind. @pre |residual| < kCoefficientLimit - 1
int32_t rounded(CoefficientModel& model, uint32_t v, uint32_t c, double residual, double lambda) {
  double magnitude = std::abs(residual);
  auto q = static_cast<int32_t>(magnitude + 0.5);
  if (q == 0 || lambda <= 0 || q > 200)
    return residual < 0 ? -q : q;
  int32_t best = 0, sign = residual < 0 ? -1 : 1;
  double least = 0;
  for (int32_t candidate = q; candidate >= (q <= 2 ? 0 : q - 1); --candidate) {
    double d = magnitude - candidate;
    double cost =
        d * d + lambda * static_cast<double>(model.cost(v, c, sign * candidate)) / kBitsPerUnit;
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
                                       uint32_t channels)
    : lambda_(settings.lambda),
      joint_lambda_(settings.joint_lambda),
      target_(std::move(target)),
      decoded_(target_.rows(), target_.cols()),
      channels_(channels),
      order_(std::move(order)),
      model_(fresh_model()),
      joint_(order_),
      layers_anew_(settings.layers_anew),
      component_(size_t{ranks()} * channels),
      residuals_(size_t{ranks()} * channels) {
  if (settings.coder == CoefficientCoder::kBatches)
    begin_batches();
  PredictionParameters prediction;
  prediction.channels = static_cast<int>(channels);
  prediction.radius = settings.radius;
  prediction.schedule = settings.schedule;
  prediction.alike = settings.alike;
  if (predictor_.init(order_, pose.data(), prediction,
                      static_cast<size_t>(target_.cols()) / channels) != Status::kOk)
    throw Error(ErrorKind::kInternal, "the predictor refuses its parameters");
}

CoefficientModel CoefficientEncoder::fresh_model() const {
  return {ranks(), channels_, order_.neighbours.data(),
          static_cast<uint32_t>(order_.neighbour_count)};
}

void CoefficientEncoder::begin_batches() {
  batches_.emplace(channels_, order_.neighbours.data(),
                   static_cast<uint32_t>(order_.neighbour_count), order_.level_start);
}

/// Ends the stream of the coder in use, and begins the next one.
Bytes CoefficientEncoder::finish_layer() {
  Bytes bytes = batches_ ? batch_encoder_.finish() : encoder_.finish();
  encoder_ = BinaryEncoder();
  batch_encoder_ = RansEncoder();
  if (layers_anew_) {
    model_ = fresh_model();
    if (batches_)
      begin_batches();
  }
  return bytes;
}

void CoefficientEncoder::take_decoded(DecodedBasis* to) && {
  const auto samples = static_cast<size_t>(decoded_.cols());
  const size_t stride = coefficient_stride(samples);
  target_.resize(0, 0);  // what follows takes as much memory
  predictor_ = EncoderPredictor();
  to->coefficients.resize(coefficient_buffer_size(order_.vertex_count(), samples));
  for (size_t i = 0; i < order_.vertex_count(); ++i)
    std::copy_n(decoded_.row(order_.order[i]).data(), samples, to->coefficients.data() + i * stride);
  to->order = std::move(order_.order);
}

template <class Coder, class Choose>
bool CoefficientEncoder::pass(CoefficientModel& model, Coder& coder, const Choose& choose) {
  model.begin_component();
  for (uint32_t i = 0; i < ranks(); ++i) {
    for (uint32_t c = 0; c < channels_; ++c) {
      const float prediction = predictor_.predict(i, static_cast<int>(c));
      const std::optional<int32_t> q = choose(i, c, prediction);
      if (!q || std::abs(*q) >= kCoefficientLimit)
        return false;
      model.code(coder, i, c, *q);
      predictor_.commit(i, static_cast<int>(c), prediction, *q);
      residuals_[size_t{c} * ranks() + i] = *q;
    }
  }
  model.end_component();
  return true;
}

/// Rounds each residual by itself, on the way to the prediction of the next.
auto CoefficientEncoder::nearest(CoefficientModel& model, const std::vector<float>& target) const {
  return [&](uint32_t i, uint32_t c, float prediction) -> std::optional<int32_t> {
    const double residual =
        static_cast<double>(target[size_t{c} * ranks() + i]) - static_cast<double>(prediction);
    if (std::abs(residual) >= kCoefficientLimit - 1)
      return std::nullopt;
    return rounded(model, i, c, residual, lambda_);
  };
}

/// The residuals as they are.
auto CoefficientEncoder::chosen() const {
  return [&](uint32_t i, uint32_t c, float) -> std::optional<int32_t> {
    return residuals_[size_t{c} * ranks() + i];
  };
}

/// Chooses the residuals of a component as a whole, what they cost by rehearsals with copies of the
/// model.
bool CoefficientEncoder::round_together() {
  constexpr int kRounds = 2;
  std::vector<float> weights;
  if (new_weights_) {
    weights.resize(order_.neighbours.size());
    predictor_.weights(weights.data());
  }
  std::vector<ResidualCosts> costs(residuals_.size());
  Rehearsal rehearsal;
  CoefficientModel model = model_;
  const auto note_costs = [&](const auto& choose) {
    return pass(model, rehearsal, [&](uint32_t i, uint32_t c, float prediction) {
      costs[size_t{c} * ranks() + i] = model.costs(i, c);
      return choose(i, c, prediction);
    });
  };
  // The first rehearsal does not need what the weights become. Isolated, so that a thread that waits
  // does not begin another trial.
  bool is_coded = false;
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_invoke(
        [&] { is_coded = note_costs(nearest(model, component_)); },
        [&] {
          if (new_weights_)
            joint_.set_weights(std::move(weights));
        });
  });
  for (int round = 0; is_coded; ++round) {
    tbb::parallel_for(uint32_t{0}, channels_, [&](uint32_t c) {
      const size_t first = size_t{c} * ranks();
      joint_.improve(component_.data() + first, costs.data() + first, joint_lambda_,
                     residuals_.data() + first);
    });
    if (round + 1 == kRounds)
      return true;
    model = model_;
    is_coded = note_costs(chosen());
  }
  return false;
}

std::optional<CoefficientEncoder::Component> CoefficientEncoder::code(size_t j) {
  const uint32_t n = ranks();
  const auto column = [&](uint32_t c) { return static_cast<Index>(j * channels_ + c); };
  for (uint32_t c = 0; c < channels_; ++c)
    for (uint32_t i = 0; i < n; ++i)
      component_[size_t{c} * n + i] = target_(order_.order[i], column(c));
  if (joint_lambda_ > 0 && !round_together())
    return std::nullopt;
  Rehearsal rehearsal;
  const auto write = [&](const auto& choose) {
    return batches_ ? pass(model_, rehearsal, choose) : pass(model_, encoder_, choose);
  };
  if (joint_lambda_ > 0 ? !write(chosen()) : !write(nearest(model_, component_)))
    return std::nullopt;
  if (batches_)
    batches_->code_component(batch_encoder_, residuals_.data());
  double energy = 0, largest = 0, largest_residual = 0;
  for (uint32_t c = 0; c < channels_; ++c) {
    const float* y = predictor_.coefficients(static_cast<int>(c));
    for (uint32_t i = 0; i < n; ++i) {
      const auto q = static_cast<double>(residuals_[size_t{c} * n + i]);
      energy += q * q;
      largest_residual = std::max(largest_residual, std::abs(q));
      largest = std::max(largest, std::abs(static_cast<double>(y[i])));
      decoded_(order_.order[i], column(c)) = y[i];
    }
  }
  Component component;
  component.wide =
      largest * (1 << kFewestFractionBits) > INT16_MAX || largest_residual > INT16_MAX;
  component.omega = omega_byte(energy / (static_cast<double>(n) * channels_));
  tbb::parallel_for(size_t{0}, predictor_.block_count(),
                    [&](size_t b) { predictor_.update(b, b + 1, component.omega); });
  new_weights_ = predictor_.refits();
  predictor_.next_component();
  return component;
}

}  // namespace anicodec
