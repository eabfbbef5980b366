// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Logistic mixing of several contexts' predictions of one bit, in integers (spec/08-entropy.md,
// section 3). After M. Mahoney, "Adaptive weighing of context models for lossless data
// compression", 2005.
#ifndef ANICODEC_FORMAT_CODING_MIXING_H_
#define ANICODEC_FORMAT_CODING_MIXING_H_

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include "format/coding/binary_coder.h"
#include "format/memory.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// stretch(p) = ln(p / (1 - p)) and its inverse squash(), from tables made by integer arithmetic
/// alone. Probabilities are in 1/65536.
class Logistic {
#if defined(ANICODEC_SMALL)
#define ANICODEC_CONSTANT  // 13 kB are made when the program starts
#else
#define ANICODEC_CONSTANT constexpr
#endif
 public:
  static constexpr int32_t kStretchLimit = 2307;  ///< |stretch()| is at most this

  /// In 1/256. @pre p < 4096, a probability in 1/4096
  static int32_t stretch(uint32_t p) {
    return kTables.stretch[p];
  }

  /// x in 1/2^21, limited to +-10. Within [3, 65533].
  static uint32_t squash(int32_t x) {
    constexpr int32_t kHalf = kSquashEntries / 2;
    const int32_t i = x >> 14;
    return kTables.squash[(i < -kHalf ? -kHalf : i > kHalf - 1 ? kHalf - 1 : i) + kHalf];
  }

 private:
  static constexpr int32_t kStretchEntries = 4096, kSquashEntries = 2560;

  struct Tables {
    int16_t stretch[kStretchEntries] = {};
    uint16_t squash[kSquashEntries] = {};
    ANICODEC_CONSTANT Tables();
  };

  static const Tables kTables;
};

/// The state of one context for one bit: the average of the bits seen, which forgets the old ones once
/// it has seen kCountLimit.
class MixCounter {
 public:
  int32_t stretch() const { return Logistic::stretch((state_ ^ kStart) >> 20); }

  void update(bool bit) {
    const uint32_t count = state_ & 1023;
    // The probability stays in [0, 2^22): the rate is below one, and rounding down cannot pass 0.
    const int64_t error = int64_t{bit ? kOne - 1 : 0} - ((state_ ^ kStart) >> 10);
    const int64_t step = (error * kAdaptationRates.value[count]) >> 15;
    state_ += static_cast<uint32_t>(step) << 10;
    state_ += count < kCountLimit;
  }

 private:
  static constexpr int32_t kOne = 1 << 22;
  static constexpr uint32_t kCountLimit = 255;
  static constexpr uint32_t kStart = uint32_t{kOne / 2} << 10;

  /// Probability of a one in 22 bits, count in 10; its highest bit is flipped, so that a counter
  /// begins as 0: compilers clear many of them by memset.
  uint32_t state_ = 0;
};

/// Learning rate of a set of weights after n bits, in 1/1024.
struct LearningRates {
  static constexpr uint32_t kCount = 320;
  int32_t value[kCount] = {};

  constexpr LearningRates() {
    for (int n = 0; n < static_cast<int>(kCount); ++n)
      value[n] = 8 + 320 / (n + 8);
  }
};

inline constexpr LearningRates kLearningRates{};

/// A set of weights, 1/8192, and what it has learnt. Unused lanes are 0 and stay 0.
struct MixWeights {
  static constexpr size_t kLanes = 8;
  static constexpr int32_t kOne = 1 << 13;
  using Lanes = std::array<int16_t, kLanes>;
#if defined(__SSE2__)
  using Inputs = __m128i;
#elif defined(__wasm_simd128__)
  using Inputs = v128_t;
#else
  using Inputs = const Lanes&;
#endif

  alignas(16) Lanes w;
  uint32_t count;

  /// In 1/2^21. |w| <= 2^15 and |input| <= 2307: eight products stay below 2^30, the sum of two
  /// results below 2^31.
  int32_t dot(Inputs inputs) const {
#if defined(__SSE2__)
    __m128i sum = _mm_madd_epi16(load(w), inputs);
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, _MM_SHUFFLE(1, 0, 3, 2)));
    sum = _mm_add_epi32(sum, _mm_shuffle_epi32(sum, _MM_SHUFFLE(2, 3, 0, 1)));
    return _mm_cvtsi128_si32(sum);
#elif defined(__wasm_simd128__)
    v128_t sum = wasm_i32x4_dot_i16x8(wasm_v128_load(w.data()), inputs);
    sum = wasm_i32x4_add(sum, wasm_i32x4_shuffle(sum, sum, 2, 3, 0, 1));
    return wasm_i32x4_extract_lane(sum, 0) + wasm_i32x4_extract_lane(sum, 1);
#else
    int32_t sum = 0;
    for (size_t i = 0; i < kLanes; ++i)
      sum += int32_t{w[i]} * inputs[i];
    return sum;
#endif
  }

  /// w += rate * error * input, rounded and saturated to 16 bits, the error being that of the
  /// prediction x; the rate falls from 3/64 to 1/128. |error| < 2^16, so |scaled| < 2^16 * 48 / 128
  /// fits 16 bits and the products stay below 2^27.
  void train(Inputs inputs, int32_t x, bool bit) {
    const int32_t error = (bit ? 65535 : 0) - static_cast<int32_t>(Logistic::squash(x));
    const auto scaled = static_cast<int16_t>((error * kLearningRates.value[count]) >> 7);
    count += count < LearningRates::kCount - 1 ? 1 : 0;
#if defined(__SSE2__)
    const __m128i in = inputs, factor = _mm_set1_epi16(scaled);
    const __m128i low = _mm_mullo_epi16(in, factor), high = _mm_mulhi_epi16(in, factor);
    const __m128i half = _mm_set1_epi32(1 << 13);
    const __m128i step0 = _mm_srai_epi32(_mm_add_epi32(_mm_unpacklo_epi16(low, high), half), 14);
    const __m128i step1 = _mm_srai_epi32(_mm_add_epi32(_mm_unpackhi_epi16(low, high), half), 14);
    _mm_store_si128(reinterpret_cast<__m128i*>(w.data()),
                    _mm_adds_epi16(load(w), _mm_packs_epi32(step0, step1)));
#elif defined(__wasm_simd128__)
    const v128_t factor = wasm_i16x8_splat(scaled), half = wasm_i32x4_splat(1 << 13);
    const v128_t low = wasm_i32x4_extmul_low_i16x8(inputs, factor);
    const v128_t high = wasm_i32x4_extmul_high_i16x8(inputs, factor);
    const v128_t step = wasm_i16x8_narrow_i32x4(wasm_i32x4_shr(wasm_i32x4_add(low, half), 14),
                                                wasm_i32x4_shr(wasm_i32x4_add(high, half), 14));
    wasm_v128_store(w.data(), wasm_i16x8_add_sat(wasm_v128_load(w.data()), step));
#else
    for (size_t i = 0; i < kLanes; ++i) {
      const int32_t sum = w[i] + ((int32_t{scaled} * inputs[i] + (1 << 13)) >> 14);
      w[i] = static_cast<int16_t>(sum < -32768 ? -32768 : sum > 32767 ? 32767 : sum);
    }
#endif
  }

 private:
#if defined(__SSE2__)
  static __m128i load(const Lanes& lanes) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(lanes.data()));
  }
#endif
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
      : selectors_(selectors) {
    for (size_t i = 0; i < kContexts; ++i) {
      offsets_[i] = per_node_;
      per_node_ += sizes[i];
    }
    counters_.resize(size_t{per_node_} * nodes);
    MixWeights start{};
    for (size_t i = 0; i < kContexts; ++i)
      start.w[i] = kStartWeight;
    weights_.resize(size_t{nodes} * (selectors[0] + selectors[1]), start);
  }

  /// Contexts and selectors of the bits that follow. @pre each below its size
  void select(const std::array<uint32_t, kContexts>& contexts, uint32_t selector0,
              uint32_t selector1) {
    for (size_t i = 0; i < kContexts; ++i)
      contexts_[i] = offsets_[i] + contexts[i];
    selector0_ = selector0;
    selector1_ = selectors_[0] + selector1;
  }

  template <class Coder>
  bool code(Coder& coder, uint32_t node, bool bit) {
    const size_t row = size_t{node} * (selectors_[0] + selectors_[1]);
    MixWeights& w0 = weights_[row + selector0_];
    MixWeights& w1 = weights_[row + selector1_];
    MixCounter* const counters = &counters_[size_t{node} * per_node_];
    const auto input = [&](size_t i) {
      return i < kContexts
                 ? static_cast<int16_t>(counters[contexts_[i < kContexts ? i : 0]].stretch())
             : i == kContexts ? kBias
                              : int16_t{0};
    };
#if defined(__SSE2__)
    const MixWeights::Inputs inputs = _mm_set_epi16(input(7), input(6), input(5), input(4),
                                                    input(3), input(2), input(1), input(0));
#elif defined(__wasm_simd128__)
    const MixWeights::Inputs inputs = wasm_i16x8_make(input(0), input(1), input(2), input(3),
                                                      input(4), input(5), input(6), input(7));
#else
    const MixWeights::Lanes inputs{input(0), input(1), input(2), input(3),
                                   input(4), input(5), input(6), input(7)};
#endif
    const int32_t x0 = w0.dot(inputs), x1 = w1.dot(inputs);
    bit = coder.bit(Logistic::squash((x0 + x1) >> 1), bit);
    if constexpr (Coder::kAdapts) {
      w0.train(inputs, x0, bit);
      w1.train(inputs, x1, bit);
      for (const uint32_t context : contexts_)
        counters[context].update(bit);
    }
    return bit;
  }

 private:
  static_assert(kContexts < MixWeights::kLanes);
  static constexpr int16_t kStartWeight =
      MixWeights::kOne * 13 / 10 / static_cast<int32_t>(kContexts);
  static constexpr int16_t kBias = 64;

  std::array<uint32_t, kContexts> offsets_{}, contexts_{};
  std::array<uint32_t, 2> selectors_;
  uint32_t per_node_ = 0, selector0_ = 0, selector1_ = 0;
  Vector<MixCounter> counters_;
  Vector<MixWeights> weights_;
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_MIXING_H_
