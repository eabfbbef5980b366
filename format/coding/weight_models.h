// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Models of the integers that time weights are coded as, by what is known around each
// (spec/08-entropy.md, section 6).
#ifndef ANICODEC_FORMAT_CODING_WEIGHT_MODELS_H_
#define ANICODEC_FORMAT_CODING_WEIGHT_MODELS_H_

#include "format/coding/magnitude_class.h"
#include "format/coding/mixing.h"
#include "format/coding/symbol_row.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace anicodec {

constexpr int kWeightUnitBits = 6;
/// Magnitudes around a value are in 1/64.
constexpr uint32_t kWeightUnit = 1U << kWeightUnitBits;

/// Half octaves of the frequencies of a transform.
constexpr uint32_t kWeightBands = 26;

/// Magnitudes of integers around one that is to be coded, in 1/kWeightUnit.
struct WeightSurroundings {
  uint32_t recent;    ///< the last two of the channel
  uint32_t slow;      ///< their running mean
  uint32_t beside;    ///< of the other channels
  uint32_t before;    ///< of the component before
  uint32_t expected;  ///< a mean of these
};

/// Mixes contexts.
class MixedWeightModel {
 public:
  MixedWeightModel()
      : frames_({kFine * 3, kMedium * kMedium, kFine * 3, kCoarse * kCoarse, kFine,
                 kMedium * kMedium},
                {kSelect, 3}),
        frequencies_({kFine * 3, kMedium * kWeightBands, kMedium * kMedium, kCoarse * kCoarse,
                      kMedium * kWeightBands},
                     {kSelect, kWeightBands}),
        signs_({27 * kSignGroups, 49 * kSignGroups, 33 * 2, 21 * kSignGroups}, {kSignGroups, 17},
               1) {}

  /// The value of channel c in frame f of a run. error: of the predictor in the last frames; spread:
  /// of all predictors; both in 1/kWeightUnit.
  void select_frame(const WeightSurroundings& s, uint32_t f, uint32_t c, uint32_t error,
                    uint32_t spread) {
    frames_.select({fine((5 * s.recent + 3 * s.slow) >> 3) * 3 + c,
                    medium(s.recent) * kMedium + medium(s.beside),
                    fine(s.before) * 3 + std::min(f, 2u),
                    coarse(s.slow) * kCoarse + coarse(s.before), fine(spread),
                    medium(error) * kMedium + medium(spread)},
                   f == 0 ? kSelect - 1 : selector(s.expected), c);
  }

  /// A frequency of channel c.
  void select_frequency(const WeightSurroundings& s, uint32_t band, uint32_t c) {
    frequencies_.select(
        {fine(s.expected) * 3 + c, medium(s.recent) * kWeightBands + band,
         medium(s.before) * kMedium + medium(s.slow), coarse(s.slow) * kCoarse + coarse(s.beside),
         medium(s.before) * kWeightBands + band},
        selector(s.expected), band);
  }

  /// The sign by those and the sizes of three values near it, and by the evidence of other channels.
  /// group: 0 of a frame, 1 to 8 of a frequency.
  void select_sign(uint32_t group, int32_t a, int32_t b, int32_t d, int32_t evidence) {
    const auto strength =
        magnitude_class<1>(static_cast<uint32_t>(evidence < 0 ? -evidence : evidence) >> 2, 16);
    const auto s = static_cast<uint32_t>(16 + sign(evidence) * static_cast<int32_t>(strength));
    signs_.select({((ternary(a) * 3 + ternary(b)) * 3 + ternary(d)) * kSignGroups + group,
                   (level(a) * 7 + level(b)) * kSignGroups + group, s * 2 + (group > 0),
                   (level(d) * 3 + ternary(a)) * kSignGroups + group},
                  group, s / 2);
  }

  /// Codes the integer that was selected. @pre |q| < 2^24
  template <class Coder>
  int32_t code(Coder& coder, bool frequency, int32_t q) {
    const auto code_sign = [&](bool negative) { return signs_.code(coder, 0, negative); };
    return frequency ? frequencies_.code(coder, q, code_sign) : frames_.code(coder, q, code_sign);
  }

 private:
  static constexpr uint32_t kFine = 28;    ///< classes of magnitudes, two per octave
  static constexpr uint32_t kMedium = 20;  ///< the same, fewer
  static constexpr uint32_t kCoarse = 14;  ///< one per octave
  static constexpr uint32_t kSelect = 8, kSignGroups = 9;

  static uint32_t fine(uint32_t x) { return magnitude_class<1>(x, kFine); }

  static uint32_t medium(uint32_t x) { return magnitude_class<1>(x, kMedium); }

  static uint32_t coarse(uint32_t x) { return magnitude_class<0>(x >> 2, kCoarse); }

  static uint32_t selector(uint32_t x) { return magnitude_class<0>(x >> 3, kSelect); }

  static int32_t sign(int32_t x) { return (x > 0) - (x < 0); }

  static uint32_t ternary(int32_t x) { return static_cast<uint32_t>(sign(x) + 1); }

  static uint32_t level(int32_t x) {
    const uint32_t magnitude = magnitude_class<0>(static_cast<uint32_t>(x < 0 ? -x : x), 4);
    return static_cast<uint32_t>(3 + sign(x) * static_cast<int32_t>(magnitude));
  }

  MixedSymbolModel<6> frames_;
  MixedSymbolModel<5> frequencies_;
  MixedModel<4> signs_;
};

/// Averages two rows of symbols: faster, and some hundredths larger.
class RowWeightModel {
 public:
  /// Codes a value of a frame, after one that was coded as `last`; 0 at the start of a run.
  /// @pre |q| < 2^24
  template <class Coder>
  int32_t code_frame(Coder& coder, const WeightSurroundings& s, int32_t last, int32_t q) {
    const int low = low_bits(s);
    const uint32_t after = last < 0 ? 0 : last == 0 ? 1 : 2;
    return code(coder, frames_, s, low, class_of(s.slow, low), signs_[after], q);
  }

  /// Codes a frequency below 2^16. @pre |q| < 2^24
  template <class Coder>
  int32_t code_frequency(Coder& coder, const WeightSurroundings& s, uint32_t frequency, int32_t q) {
    return code(coder, frequencies_, s, low_bits(s),
                static_cast<uint32_t>(floor_log2(frequency)), signs_[3], q);
  }

 private:
  static constexpr uint32_t kExpected = 18, kRecent = 16;

  struct Rows {
    SymbolRow expected[kExpected], recent[kRecent][kRecent];
    RowNumber far;
  };

  /// The lowest bits of what is expected to be large are as good as random.
  static int low_bits(const WeightSurroundings& s) {
    return std::max(floor_log2(s.expected >> kWeightUnitBits) - 2, 0);
  }

  static uint32_t class_of(uint32_t magnitude, int low) {
    return magnitude_class<0>(magnitude >> (low + 2), kRecent);
  }

  template <class Coder>
  static int32_t code(Coder& coder, Rows& rows, const WeightSurroundings& s, int low,
                      uint32_t second, AdaptiveBit& sign, int32_t q) {
    SymbolRow& expected = rows.expected[magnitude_class<1>(s.expected >> low)];
    SymbolRow& recent = rows.recent[class_of(s.recent, low)][second];
    const auto magnitude = static_cast<int32_t>(code_row_magnitude(
        coder, expected, recent, rows.far, low, static_cast<uint32_t>(q < 0 ? -q : q)));
    return magnitude == 0 ? 0 : coder.bit(sign, q < 0) ? -magnitude : magnitude;
  }

  Rows frames_, frequencies_;
  AdaptiveBit signs_[4];  ///< of a frame after a negative value, after 0, after another; of a frequency
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_WEIGHT_MODELS_H_
