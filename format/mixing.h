// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Logistic mixing of several contexts' predictions of one bit, in integers (spec/08-entropy.md,
// section 3). After M. Mahoney, "Adaptive weighing of context models for lossless data
// compression", 2005.
#ifndef ANICODEC_FORMAT_MIXING_H_
#define ANICODEC_FORMAT_MIXING_H_

#include "format/binary_coder.h"
#include "format/symbol_model.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace anicodec {

/// stretch(p) = ln(p / (1 - p)) and its inverse squash(), from tables made by integer arithmetic
/// alone. The logistic domain is in 1/1024, probabilities in 1/65536.
class Logistic {
 public:
  static constexpr int32_t kLimit = 10 << 10;  ///< squash() takes everything beyond as the limit

  /// @pre p < 4096, a probability in 1/4096. Result within +-9230.
  static int32_t stretch(uint32_t p) { return kTables.stretch[p]; }

  /// In 1/65536, within [2, 65534].
  static uint32_t squash(int32_t x) {
    x = x < -kLimit ? -kLimit : x > kLimit - 1 ? kLimit - 1 : x;
    return kTables.squash[(x + kLimit) >> kSquashShift];
  }

 private:
  static constexpr int kStretchEntries = 4096, kSquashShift = 3;

  struct Tables {
    int16_t stretch[kStretchEntries];
    uint16_t squash[(2 * kLimit) >> kSquashShift];
    constexpr Tables();
  };

  static const Tables kTables;
};

/// What one context knows of one bit: the average of the bits seen, which forgets the old ones once
/// it has seen kMixCountLimit.
class MixCounter {
 public:
  int32_t stretch() const { return Logistic::stretch(state_ >> 20); }

  void update(bool bit) {
    const uint32_t count = state_ & 1023;
    const auto p = static_cast<int32_t>(state_ >> 10);
    const int64_t step = int64_t{(bit ? kOne - 1 : 0) - p} * kAdaptationRates.value[count];
    // p stays in [0, kOne): the rate is below one, and rounding down cannot pass 0.
    state_ = static_cast<uint32_t>(p + static_cast<int32_t>(step >> 15)) << 10 |
             (count + (count < kCountLimit ? 1 : 0));
  }

 private:
  static constexpr int32_t kOne = 1 << 22;
  static constexpr uint32_t kCountLimit = 255;

  uint32_t state_ = uint32_t{kOne / 2} << 10;  ///< probability of a one in 22 bits, count in 10
};

/// Codes bits, each of one of `nodes` kinds (the decisions of a binarisation), in kContexts
/// contexts at once. Two sets of weights per node, each picked by a selector of its own, mix what
/// the contexts predict; their mean in the logistic domain is the prediction, and each learns from
/// its own error.
template <size_t kContexts>
class MixedModel {
 public:
  /// sizes[i]: number of values of context i; selectors[s]: of selector s.
  MixedModel(const std::array<uint32_t, kContexts>& sizes, const std::array<uint32_t, 2>& selectors,
             uint32_t nodes)
      : sizes_(sizes), selectors_(selectors) {
    uint32_t total = 0;
    for (size_t i = 0; i < kContexts; ++i) {
      offsets_[i] = total;
      total += sizes[i] * nodes;
    }
    counters_.resize(total);
    Weights start;
    start.w.fill(kStartWeight);
    start.w[kContexts] = 0;
    weights_.resize(size_t{nodes} * (selectors[0] + selectors[1]), start);
  }

  /// Contexts and selectors of the bits that follow. @pre each below its size
  void select(const std::array<uint32_t, kContexts>& contexts, uint32_t selector0,
              uint32_t selector1) {
    contexts_ = contexts;
    selector0_ = selector0;
    selector1_ = selectors_[0] + selector1;
  }

  template <class Coder>
  bool code(Coder& coder, uint32_t node, bool bit) {
    std::array<MixCounter*, kContexts> counters;
    std::array<int32_t, kContexts + 1> inputs;
    for (size_t i = 0; i < kContexts; ++i) {
      counters[i] = &counters_[offsets_[i] + node * sizes_[i] + contexts_[i]];
      inputs[i] = counters[i]->stretch();
    }
    inputs[kContexts] = kBias;
    const size_t row = size_t{node} * (selectors_[0] + selectors_[1]);
    Weights& w0 = weights_[row + selector0_];
    Weights& w1 = weights_[row + selector1_];
    const int32_t x0 = dot(w0, inputs), x1 = dot(w1, inputs);
    bit = coder.bit(Logistic::squash((x0 + x1) >> 1), bit);
    if constexpr (Coder::kAdapts) {
      train(w0, inputs, x0, bit);
      train(w1, inputs, x1, bit);
      for (MixCounter* counter : counters)
        counter->update(bit);
    }
    return bit;
  }

 private:
  static constexpr int32_t kWeightOne = 1 << 16;
  static constexpr int32_t kWeightLimit = 8 * kWeightOne;
  static constexpr int32_t kStartWeight = kWeightOne * 13 / 10 / static_cast<int32_t>(kContexts);
  static constexpr int32_t kBias = 256;

  struct Weights {
    std::array<int32_t, kContexts + 1> w;
    uint32_t count = 0;
  };

  /// |w| <= 2^19 and |input| < 2^14, so 64 bits hold the sum of any number of contexts; the result
  /// is limited to what squash() tells apart, so sums of two stay far within 32 bits.
  static int32_t dot(const Weights& weights, const std::array<int32_t, kContexts + 1>& inputs) {
    int64_t sum = 0;
    for (size_t i = 0; i <= kContexts; ++i)
      sum += int64_t{weights.w[i]} * inputs[i];
    sum >>= 16;
    return static_cast<int32_t>(sum < -Logistic::kLimit  ? -Logistic::kLimit
                                : sum > Logistic::kLimit ? Logistic::kLimit
                                                         : sum);
  }

  /// w += rate * error * input, rounded; the rate falls from 3/64 to 1/128.
  /// |error * input| < 2^30, times a rate of at most 48: 64 bits.
  static void train(Weights& weights, const std::array<int32_t, kContexts + 1>& inputs, int32_t x,
                    bool bit) {
    const int32_t error = (bit ? 65535 : 0) - static_cast<int32_t>(Logistic::squash(x));
    const int64_t scaled = int64_t{error} * kRates.value[weights.count];
    weights.count += weights.count < Rates::kCount - 1 ? 1 : 0;
    for (size_t i = 0; i <= kContexts; ++i) {
      const int64_t w = weights.w[i] + ((scaled * inputs[i] + (1 << 19)) >> 20);
      weights.w[i] = static_cast<int32_t>(w < -kWeightLimit  ? -kWeightLimit
                                          : w > kWeightLimit ? kWeightLimit
                                                             : w);
    }
  }

  struct Rates {
    static constexpr uint32_t kCount = 320;
    int32_t value[kCount];

    constexpr Rates() : value{} {
      for (int n = 0; n < static_cast<int>(kCount); ++n)
        value[n] = 8 + 320 / (n + 8);
    }
  };

  static constexpr Rates kRates{};

  std::array<uint32_t, kContexts> sizes_, offsets_{}, contexts_{};
  std::array<uint32_t, 2> selectors_;
  uint32_t selector0_ = 0, selector1_ = 0;
  std::vector<MixCounter> counters_;
  std::vector<Weights> weights_;
};

/// code_symbol() with mixed contexts: the zero flag, the exponent and the first mantissa bits are
/// mixed, the rare rest has one adaptive bit per node. Magnitudes below 2^24.
template <size_t kContexts>
class MixedSymbolModel {
 public:
  MixedSymbolModel(const std::array<uint32_t, kContexts>& sizes,
                   const std::array<uint32_t, 2>& selectors)
      : mixed_(sizes, selectors, kMixedNodes) {}

  void select(const std::array<uint32_t, kContexts>& contexts, uint32_t selector0,
              uint32_t selector1) {
    mixed_.select(contexts, selector0, selector1);
  }

  /// `sign(bool)` codes whether the value is negative.
  template <class Coder, class SignCoder>
  int32_t code(Coder& coder, int32_t value, SignCoder&& sign) {
    return code_symbol<Sign::kModelled, 23>(
        value,
        [&](uint32_t node, bool bit) {
          if (node == 1)
            return sign(bit);
          if (node == 0)
            return mixed_.code(coder, 0, bit);
          if (node < 2 + kExponents)
            return mixed_.code(coder, node - 1, bit);
          if (node >= 22 && node < 22 + kMantissas)
            return mixed_.code(coder, node - 21 + kExponents, bit);
          return coder.bit(rare_[node], bit);
        },
        [&](int count, uint32_t bits) { return coder.raw(count, bits); });
  }

 private:
  static constexpr uint32_t kExponents = 10, kMantissas = 9;
  static constexpr uint32_t kMixedNodes = 1 + kExponents + kMantissas;

  MixedModel<kContexts> mixed_;
  AdaptiveBit rare_[kSymbolNodes];
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_MIXING_H_
