// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Model of the integers that time weights are coded as, by what is known around each
// (spec/08-entropy.md, section 6).
#ifndef ANICODEC_FORMAT_CODING_WEIGHT_MODEL_H_
#define ANICODEC_FORMAT_CODING_WEIGHT_MODEL_H_

#include "format/coding/magnitude_class.h"
#include "format/coding/weighted_rows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace anicodec {

constexpr int kWeightUnitBits = 6;
/// Magnitudes around a value are in 1/64.
constexpr uint32_t kWeightUnit = 1U << kWeightUnitBits;

/// The surroundings of an integer that is to be coded. Magnitudes are in 1/kWeightUnit.
struct WeightSurroundings {
  uint32_t recent;    ///< the last two of the channel
  uint32_t slow;      ///< their running mean
  uint32_t beside;    ///< of the other channels
  uint32_t before;    ///< of the component before
  uint32_t expected;  ///< a mean of these
  uint32_t pattern;   ///< bit i: the component before is not 0 at i - 1 places from here
  int32_t signs[2];   ///< what the sign may follow: integers before, how predictions differ
  int32_t evidence;   ///< of the sign, by the channels before
};

/// Averages four rows of symbols by learnt weights. Memory: 50 kB.
class WeightModel {
 public:
  /// Codes a value of a frame. spread: how far two predictions are apart. @pre |q| < 2^24
  template <class Coder>
  int32_t code_frame(Coder& coder, const WeightSurroundings& s, uint32_t spread, int32_t q) {
    const int low = low_bits(s);
    return code(coder, frames_, s, low, class_of(s.slow, low),
                magnitude_class<1>(spread >> low, kBands), signs_[0], q);
  }

  /// Codes a frequency below 2^16. @pre |q| < 2^24
  template <class Coder>
  int32_t code_frequency(Coder& coder, const WeightSurroundings& s, uint32_t frequency, int32_t q) {
    const uint32_t band = magnitude_class<1>(frequency, kBands);
    return code(coder, frequencies_, s, low_bits(s), static_cast<uint32_t>(floor_log2(frequency)),
                band, signs_[1 + std::min(band, kSignBands - 1)], q);
  }

 private:
  static constexpr uint32_t kExpected = 18, kRecent = 16, kPatterns = 32;
  static constexpr uint32_t kBands = 26;  ///< half octaves of frequencies, or of spreads
  static constexpr uint32_t kSignBands = 8, kWeights = 8;
  static constexpr int kEvidence = 15;

  using SignBits = AdaptiveBit[3][3];

  struct Rows {
    SymbolRow expected[kExpected], recent[kRecent][kRecent], beside[kRecent][kPatterns],
        before[kBands][kRecent];
    SymbolRow expected_excess[kExpected], recent_excess[kRecent], beside_excess[kRecent];
    RowWeights weights[kWeights];
    RowNumber far;
    AdaptiveBit evidence[2 * kEvidence + 1];
  };

  /// The lowest bits of what is expected to be large are as good as random.
  static int low_bits(const WeightSurroundings& s) {
    return std::max(floor_log2(s.expected >> kWeightUnitBits) - 2, 0);
  }

  static uint32_t class_of(uint32_t magnitude, int low) {
    return magnitude_class<0>(magnitude >> (low + 2), kRecent);
  }

  static size_t ternary(int32_t x) { return static_cast<size_t>((x > 0) - (x < 0) + 1); }

  template <class Coder>
  static int32_t code(Coder& coder, Rows& rows, const WeightSurroundings& s, int low,
                      uint32_t second, uint32_t band, SignBits& signs, int32_t q) {
    const uint32_t pattern =
        4 * s.pattern + (s.recent > 0 ? 1 : 0) + (s.slow >= kWeightUnit ? 2 : 0);
    const uint32_t expected = magnitude_class<1>(s.expected >> low, kExpected);
    const uint32_t recent = class_of(s.recent, low), beside = class_of(s.beside, low);
    const FourRows four = {&rows.expected[expected], &rows.recent[recent][second],
                           &rows.beside[beside][pattern],
                           &rows.before[band][class_of(s.before, low)]};
    RowWeights& weights = rows.weights[magnitude_class<0>(s.expected >> 3, kWeights)];
    const auto symbol = [&](uint32_t x) { return code_weighted_symbol(coder, four, weights, x); };
    const auto more = [&](uint32_t x) {
      return code_row_symbol(coder, rows.expected_excess[expected], rows.recent_excess[recent],
                             rows.beside_excess[beside], x);
    };
    const auto magnitude = static_cast<int32_t>(code_row_magnitude(
        coder, symbol, more, rows.far, low, static_cast<uint32_t>(q < 0 ? -q : q)));
    if (magnitude == 0)
      return 0;
    const int32_t e = s.evidence;
    const auto strength = static_cast<int32_t>(
        magnitude_class<1>(static_cast<uint32_t>(e < 0 ? -e : e) >> 2, kEvidence + 1));
    AdaptiveBit& a = rows.evidence[static_cast<size_t>(kEvidence + (e < 0 ? -strength : strength))];
    AdaptiveBit& b = signs[ternary(s.signs[0])][ternary(s.signs[1])];
    const bool negative = coder.bit((a.probability() + b.probability()) >> 1, q < 0);
    if constexpr (Coder::kAdapts) {
      a.update(negative);
      b.update(negative);
    }
    return negative ? -magnitude : magnitude;
  }

  Rows frames_, frequencies_;
  SignBits signs_[1 + kSignBands];  ///< of frames, of frequencies by band
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_WEIGHT_MODEL_H_
