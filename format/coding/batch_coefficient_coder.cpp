// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/batch_coefficient_coder.h"

namespace anicodec {
namespace {

/// Twice the middle of a class, two to an octave.
uint32_t middle(uint32_t c) {
  const auto low = [](uint32_t x) { return x < 2 ? x : (2 + (x & 1)) << (x / 2 - 1); };
  return low(c) + low(c + 1);
}

}  // namespace

BatchCoefficientModel::BatchCoefficientModel(uint32_t channels, const int32_t* neighbours,
                                             uint32_t stride, const Vector<uint32_t>& level_start)
    : ranks_(level_start.empty() ? 0 : level_start.back()),
      channels_(channels),
      stride_(stride),
      near_scale_((16U << 16) / (23 * channels)),
      neighbours_(neighbours),
      level_start_(level_start),
      near_rows_(size_t{kClasses} * kClasses * kStates),
      past_rows_(size_t{kClasses} * kComponents * kStates),
      near_excess_(size_t{kClasses} * kClasses),
      past_excess_(size_t{kClasses} * kComponents),
      dependent_start_(size_t{ranks_} + 1, 0),
      near_(ranks_, 0),
      magnitude_(ranks_, 0),
      history_(ranks_, 0),
      past_(ranks_, 0),
      sign_((size_t{ranks_} + 1) * channels, 0),
      agreement_(size_t{ranks_} * kNear, 0) {
  if (stride < kNear) {
    padded_.assign(size_t{ranks_} * kNear, -1);
    for (uint32_t r = 0; r < ranks_; ++r)
      std::copy_n(neighbours + size_t{r} * stride, stride, &padded_[size_t{r} * kNear]);
    neighbours_ = padded_.data();
    stride_ = kNear;
  }
  list_dependents();
  // The expectation of a context that has seen nothing yet.
  for (uint32_t near = 0; near < kClasses; ++near)
    for (uint32_t history = 0; history < kClasses; ++history)
      for (uint32_t state = 0; state < kStates; ++state)
        near_rows_[(near * kClasses + history) * kStates + state].start(
            11 * (middle(near) + 3 * middle(history)), 2048);
  for (uint32_t past = 0; past < kClasses; ++past)
    for (uint32_t i = 0; i < kComponents * kStates; ++i)
      past_rows_[past * kComponents * kStates + i].start(middle(past), 64);
}

/// Turns the lists of neighbours round: where most residuals are 0, it is less to add each of the
/// others to the vertices that it concerns than to gather neighbours for all.
void BatchCoefficientModel::list_dependents() {
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

void BatchCoefficientModel::begin_component() {
  std::fill(near_.begin(), near_.end(), uint16_t{0});
  std::fill(magnitude_.begin(), magnitude_.end(), uint8_t{0});
  std::fill(sign_.begin(), sign_.end(), int8_t{0});
}

void BatchCoefficientModel::end_component() {
  const uint32_t unit = 256 / channels_;
  for (size_t r = 0; r < ranks_; ++r) {
    const uint32_t m = magnitude_[r] * unit;
    history_[r] = static_cast<uint16_t>((history_[r] + m) >> 1);
    past_[r] = static_cast<uint16_t>((27U * past_[r] + 5 * m) >> 5);
  }
  ++component_;
}

}  // namespace anicodec
