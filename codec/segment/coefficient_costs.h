// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_COEFFICIENT_COSTS_H_
#define ANICODEC_CODEC_SEGMENT_COEFFICIENT_COSTS_H_

#include "format/coding/bit_cost.h"
#include "format/coding/coefficient_model.h"
#include "format/memory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace anicodec {

/// Lets a model learn as from coding, and writes nothing.
struct Rehearsal {
  static constexpr bool kAdapts = true;
  static constexpr bool kDecodes = false;

  bool bit(AdaptiveBit& model, bool value) {
    model.update(value);
    return value;
  }

  template <class Distribution>
  uint32_t symbol(const Distribution&, uint32_t s) {
    return s;
  }

  uint32_t raw(int, uint32_t value) { return value; }

  bool ok() const { return true; }

  void fail() {}
};

/// The bits that a residual of any magnitude would take, about.
inline float bits_of(const ResidualCosts& costs, int32_t q) {
  constexpr float kExcess = 2, kOctave = 0.8F;  // of what is beyond the symbols of a row
  const uint32_t magnitude = static_cast<uint32_t>(std::abs(q));
  const float sign = q == 0 ? 0 : q > 0 ? costs.positive : costs.negative;
  if (magnitude < kRowEscape)
    return sign + costs.magnitude[magnitude];
  return sign + costs.magnitude[kRowEscape] + kExcess +
         kOctave * static_cast<float>(floor_log2(magnitude - 3));
}

/// Ranks that are coded together.
struct BatchCosts {
  uint32_t first = 0, end = 0;
  float zero_saves = 0;  ///< CoefficientModel::zero_saves()
};

/// Codes residuals one by one, for an encoder that asks before each what it would take. The model codes
/// batches: it is asked as it is before the batch, and codes it with its last residual.
class CoefficientCosts {
 public:
  /// The arguments of CoefficientModel.
  CoefficientCosts(uint32_t channels, const int32_t* neighbours, uint32_t stride,
                   const Vector<uint32_t>& level_start)
      : CoefficientCosts(CoefficientModel(channels, neighbours, stride, level_start)) {}

  explicit CoefficientCosts(CoefficientModel model)
      : model_(std::move(model)), q_(size_t{model_.ranks()} * model_.channels()) {}

  void begin_component() {
    model_.begin_component();
    batches_.clear();
    std::fill(q_.begin(), q_.end(), 0);
    level_ = 0;
    first_ = end_ = 0;
  }

  void end_component() { model_.end_component(); }

  /// Costs of the batches of the component at hand, as far as it is coded.
  const std::vector<BatchCosts>& batches() const { return batches_; }

  /// The costs of residuals of channel c of rank v. @pre code() is next for it
  ResidualCosts costs(uint32_t v, uint32_t c) {
    begin_vertex(v);
    uint32_t sum = 0;
    for (uint32_t e = 0; e < c; ++e)
      sum += static_cast<uint32_t>(std::abs(q_[at(v, e)]));
    return model_.costs(contexts_, v, c, sum, q_.data());
  }

  /// Codes the residual of channel c of rank v: ascending v, for each v ascending c.
  /// @pre |q| < kCoefficientLimit
  template <class Coder>
  void code(Coder& coder, uint32_t v, uint32_t c, int32_t q) {
    begin_vertex(v);
    q_[at(v, c)] = q;
    if (v + 1 == end_ && c + 1 == model_.channels())
      model_.code_batch(coder, first_, end_ - first_, q_.data());
  }

  /// The same of all residuals of a component at once.
  template <class Coder>
  void code_component(Coder& coder, const int32_t* q) {
    std::copy_n(q, q_.size(), q_.begin());
    model_.code_component(coder, q_.data());
  }

 private:
  size_t at(uint32_t v, uint32_t c) const { return size_t{c} * model_.ranks() + v; }

  void begin_vertex(uint32_t v) {
    if (v >= end_) {
      const Vector<uint32_t>& start = model_.level_start();
      while (start[level_ + 1] <= v)
        ++level_;
      first_ = v;
      end_ = std::min(start[level_ + 1], v + CoefficientModel::kBatch);
      batches_.push_back({first_, end_, model_.zero_saves(first_, end_ - first_)});
    } else if (v == vertex_) {
      return;
    }
    vertex_ = v;
    contexts_ = model_.contexts_of(v);
  }

  CoefficientModel model_;
  std::vector<BatchCosts> batches_;
  std::vector<int32_t> q_;  ///< of the component at hand, channels x ranks
  size_t level_ = 0;
  uint32_t first_ = 0, end_ = 0;  ///< of the batch at hand
  uint32_t vertex_ = 0;
  CoefficientModel::Vertex contexts_{};  ///< of that vertex
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_COEFFICIENT_COSTS_H_
