// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/coefficient_model.h"

#include <limits>

namespace anicodec {
namespace {

/// Twice the middle of a class, two to an octave.
uint32_t middle(uint32_t c) {
  const auto low = [](uint32_t x) { return x < 2 ? x : (2 + (x & 1)) << (x / 2 - 1); };
  return low(c) + low(c + 1);
}

/// The lowest number of a class, four to an octave.
uint32_t lowest(uint32_t c) {
  return c < 4 ? c : (4 + (c & 3)) << (c / 4 - 1);
}

float in_bits(uint32_t probability) {
  return static_cast<float>(bit_cost(probability)) / static_cast<float>(kBitCostOne);
}

}  // namespace

CoefficientModel::CoefficientModel(uint32_t channels, const int32_t* neighbours, uint32_t stride,
                                   const Vector<uint32_t>& level_start)
    : ranks_(level_start.empty() ? 0 : level_start.back()),
      channels_(channels),
      stride_(stride),
      near_scale_((16U << 16) / (23 * channels)),
      neighbours_(neighbours),
      level_start_(&level_start),
      expected_rows_(size_t{kExpected} * kStates),
      near_rows_(size_t{kClasses} * kClasses * kStates),
      past_rows_(size_t{kClasses} * kComponents * kStates),
      expected_excess_(kExpected),
      near_excess_(size_t{kClasses} * kClasses),
      past_excess_(size_t{kClasses} * kComponents),
      dependent_start_(size_t{ranks_} + 1, 0),
      near_(ranks_, 0),
      history_(ranks_, 0),
      past_(ranks_, 0),
      around_(ranks_, 0),
      magnitude_(ranks_, 0),
      sign_((size_t{ranks_} + 1) * channels, 0),
      agreement_(size_t{ranks_} * kNear, 0) {
  list_dependents();
  // The expectation of a context that has seen nothing yet.
  for (uint32_t expected = 0; expected < kExpected; ++expected)
    for (uint32_t state = 0; state < kStates; ++state)
      expected_rows_[expected * kStates + state].start(2 * lowest(expected) + 1, 2 * kUnit);
  for (uint32_t near = 0; near < kClasses; ++near)
    for (uint32_t history = 0; history < kClasses; ++history)
      for (uint32_t state = 0; state < kStates; ++state)
        near_rows_[(near * kClasses + history) * kStates + state].start(
            11 * (middle(near) + 3 * middle(history)), 2048);
  for (uint32_t past = 0; past < kClasses; ++past)
    for (uint32_t i = 0; i < kComponents * kStates; ++i)
      past_rows_[past * kComponents * kStates + i].start(middle(past), 64);
}

void CoefficientModel::continue_with(const int32_t* neighbours,
                                     const Vector<uint32_t>& level_start) {
  neighbours_ = neighbours;
  level_start_ = &level_start;
  component_ = recent_ = 0;
}

/// Turns the lists of neighbours round: where most residuals are 0, it is less to add each of the
/// others to the vertices that it concerns than to gather neighbours for all.
void CoefficientModel::list_dependents() {
  constexpr uint8_t kWeights[] = {6, 5, 4, 3, 3, 2};
  constexpr size_t kWeighted = sizeof kWeights;
  const auto for_each = [&](auto&& visit) {
    for (uint32_t r = 0; r < ranks_; ++r) {
      const int32_t* n = neighbours_ + size_t{r} * stride_;
      for (size_t a = 0; a < kWeighted && n[a] >= 0; ++a)
        visit(r, static_cast<uint32_t>(n[a]), kWeights[a]);
    }
  };
  for_each([&](uint32_t, uint32_t neighbour, uint8_t) { ++dependent_start_[neighbour]; });
  uint32_t end = 0;
  for (uint32_t& start : dependent_start_)
    start = end += start;
  dependents_.resize(end);
  dependent_weights_.resize(end);
  for_each([&](uint32_t r, uint32_t neighbour, uint8_t weight) {
    const uint32_t at = --dependent_start_[neighbour];
    dependents_[at] = r;
    dependent_weights_[at] = weight;
  });
}

void CoefficientModel::begin_component() {
  std::fill(near_.begin(), near_.end(), uint16_t{0});
  std::fill(magnitude_.begin(), magnitude_.end(), uint8_t{0});
  std::fill(sign_.begin(), sign_.end(), int8_t{0});
  run_ = 0;
}

void CoefficientModel::end_component() {
  const int unit = kUnit / static_cast<int>(channels_);
  for (uint32_t r = 0; r < ranks_; ++r) {
    const int m = magnitude_[r] * unit, near = static_cast<int>(near_of(r));
    history_[r] = static_cast<int16_t>(history_[r] + ((m - history_[r]) >> 1));
    past_[r] = static_cast<int16_t>(past_[r] + ((5 * (m - past_[r])) >> 5));
    around_[r] = static_cast<int16_t>(around_[r] + ((5 * (near - around_[r])) >> 5));
  }
  ++component_;
}

CoefficientModel::Vertex CoefficientModel::contexts_of(uint32_t rank) const {
  int16_t features[kFeatures];
  set_features(rank, 1, features);
  return classes_of(features, 1, expected_of(features, 1));
}

float CoefficientModel::zero_saves(uint32_t first, uint32_t count) const {
  const uint32_t total = total_of(first, count);
  if (total >= kBusy)
    return -std::numeric_limits<float>::infinity();
  const uint32_t any = any_[magnitude_class<2>(total >> 1, kTotals)][recent_].probability();
  return in_bits(any) - in_bits(kProbabilityOne - any);
}

ResidualCosts CoefficientModel::costs(const Vertex& vertex, uint32_t rank, uint32_t channel,
                                      uint32_t sum, const int32_t* q) const {
  ResidualCosts costs;
  const uint32_t state = state_of(channel, sum);
  const SymbolDistribution symbols(expected_rows_[vertex.expected * kStates + state],
                                   near_rows_[vertex.near * kStates + state],
                                   past_rows_[vertex.past * kStates + state]);
  constexpr uint32_t kUnitOfPart = kProbabilityOne / kSymbolScale;
  for (uint32_t s = 0; s < kRowSymbols; ++s)
    costs.magnitude[s] = in_bits(kUnitOfPart * (symbols.start(s + 1) - symbols.start(s)));
  int agreed = 0;
  for (size_t a = 0; a < kNear; ++a) {
    const int32_t n = neighbours_[size_t{rank} * stride_ + a];
    const int32_t x = n < 0 ? 0 : q[size_t{channel} * ranks_ + static_cast<size_t>(n)];
    agreed += ((x > 0) - (x < 0)) * (agreement_[size_t{rank} * kNear + a] + kSignWeights[a]);
  }
  const uint32_t negative = signs_[sign_class(agreed)].probability();
  costs.negative = in_bits(negative);
  costs.positive = in_bits(kProbabilityOne - negative);
  return costs;
}

}  // namespace anicodec
