// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Adaptive distributions of eight symbols, several of them averaged for each symbol
// (spec/08-entropy.md, section 5).
#ifndef ANICODEC_FORMAT_CODING_SYMBOL_ROW_H_
#define ANICODEC_FORMAT_CODING_SYMBOL_ROW_H_

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include "format/coding/binary_coder.h"
#include "format/coding/magnitude_class.h"
#include "format/coding/symbol_model.h"
#include "format/compiler.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace anicodec {

constexpr size_t kRowSymbols = 8;
/// The last symbol of a row stands for all larger numbers.
constexpr uint32_t kRowEscape = kRowSymbols - 1;

/// Counts of a context: element i < 7 is the probability of a symbol of at most i, in 1/32768;
/// element 7 how many symbols it has seen, up to kLimit.
struct alignas(16) SymbolRow {
  static constexpr uint16_t kLimit = 30;  ///< best of 22, 30, 40 on five clips of research

  uint16_t v[kRowSymbols] = {4096, 8192, 12288, 16384, 20480, 24576, 28672, 1};

  /// Starts as the distribution of a geometric sequence: symbol i + 1 is a / (a + b) times as likely
  /// to be passed as symbol i. @pre a + b < 2^16
  void start(uint32_t a, uint32_t b) {
    constexpr uint16_t kTrust = 3;
    uint32_t rest = kSymbolScale;
    for (uint32_t i = 0; i < kRowEscape; ++i) {
      rest = rest * a / (a + b);
      const uint32_t least = 8 * (kRowEscape - i);
      v[i] = static_cast<uint16_t>(kSymbolScale - (rest < least ? least : rest));
    }
    v[kRowEscape] = kTrust;
  }
};

/// The arithmetic of rows, symbol after symbol.
struct PlainRows {
  /// The start of each symbol but the first in the mean of row a and of the mean of b and c, up to
  /// 32768; none is less likely than 8 / 32768.
  static void mix(const SymbolRow& a, const SymbolRow& b, const SymbolRow& c, uint16_t* to) {
    uint16_t mean[kRowEscape];
    for (uint32_t i = 0; i < kRowEscape; ++i) {
      const uint32_t others = (uint32_t{b.v[i]} + c.v[i] + 1) >> 1;
      mean[i] = static_cast<uint16_t>((a.v[i] + others + 1) >> 1);
    }
    starts_of(mean, to);
  }

  /// The same of the mean of four rows by weights in 1/32768, together at most 1, each below 1.
  static void mix(const SymbolRow* const* rows, const uint16_t* weights, uint16_t* to) {
    uint16_t mean[kRowEscape];
    for (uint32_t i = 0; i < kRowEscape; ++i) {
      uint32_t sum = 0;
      for (size_t k = 0; k < 4; ++k)
        sum += uint32_t{weights[k]} * rows[k]->v[i];
      mean[i] = static_cast<uint16_t>(sum >> kSymbolBits);
    }
    starts_of(mean, to);
  }

  static void starts_of(const uint16_t* mean, uint16_t* to) {
    for (uint32_t i = 0; i < kRowEscape; ++i)
      to[i] = static_cast<uint16_t>(mean[i] - (mean[i] >> 9) + 8 * (i + 1));
    to[kRowEscape] = static_cast<uint16_t>(kSymbolScale);
  }

  /// How many of seven starts are at most x.
  static uint32_t find(const uint16_t* starts, uint32_t x) {
    uint32_t s = 0;
    for (uint32_t i = 0; i < kRowEscape; ++i)
      s += starts[i] <= x;
    return s;
  }

  static ANICODEC_INLINE void learn(SymbolRow& row, uint32_t s) {
    const uint16_t seen = row.v[kRowEscape];
    for (uint32_t i = 0; i < kRowEscape; ++i) {
      const int32_t error = (s <= i ? 32767 : 0) - int32_t{row.v[i]};
      row.v[i] = static_cast<uint16_t>(row.v[i] + ((error * kAdaptationRates.value[seen]) >> 15));
    }
    row.v[kRowEscape] = static_cast<uint16_t>(seen + (seen < SymbolRow::kLimit));
  }
};

#if defined(__SSE2__)
/// The same by vectors of 16 bytes.
struct VectorRows {
  static void mix(const SymbolRow& a, const SymbolRow& b, const SymbolRow& c, uint16_t* to) {
    starts_of(_mm_avg_epu16(load(a.v), _mm_avg_epu16(load(b.v), load(c.v))), to);
  }

  static void mix(const SymbolRow* const* rows, const uint16_t* weights, uint16_t* to) {
    const auto pair = [&](size_t k) {
      return _mm_set1_epi32(static_cast<int32_t>(weights[k] | uint32_t{weights[k + 1]} << 16));
    };
    const __m128i a = load(rows[0]->v), b = load(rows[1]->v), c = load(rows[2]->v),
                  d = load(rows[3]->v), ab = pair(0), cd = pair(2);
    const __m128i low = _mm_add_epi32(_mm_madd_epi16(_mm_unpacklo_epi16(a, b), ab),
                                      _mm_madd_epi16(_mm_unpacklo_epi16(c, d), cd));
    const __m128i high = _mm_add_epi32(_mm_madd_epi16(_mm_unpackhi_epi16(a, b), ab),
                                       _mm_madd_epi16(_mm_unpackhi_epi16(c, d), cd));
    starts_of(_mm_packs_epi32(_mm_srli_epi32(low, kSymbolBits), _mm_srli_epi32(high, kSymbolBits)),
              to);
  }

  static void starts_of(__m128i mean, uint16_t* to) {
    const __m128i floor = _mm_set_epi16(0, 56, 48, 40, 32, 24, 16, 8);
    __m128i starts = _mm_add_epi16(_mm_sub_epi16(mean, _mm_srli_epi16(mean, 9)), floor);
    starts = _mm_insert_epi16(starts, -32768, 7);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), starts);
  }

  static uint32_t find(const uint16_t* starts, uint32_t x) {
    const __m128i above = _mm_cmpgt_epi16(load(starts), _mm_set1_epi16(static_cast<short>(x)));
    const auto mask = static_cast<uint32_t>(_mm_movemask_epi8(above)) | 1U << 14;
    return static_cast<uint32_t>(lowest_bit(mask)) / 2;
  }

  static ANICODEC_INLINE void learn(SymbolRow& row, uint32_t s) {
    const __m128i old = load(row.v);
    const int seen = _mm_extract_epi16(old, 7);
    const __m128i index = _mm_set_epi16(-1, 6, 5, 4, 3, 2, 1, 0);
    const __m128i below = _mm_cmpgt_epi16(_mm_set1_epi16(static_cast<short>(s)), index);
    const __m128i target = _mm_andnot_si128(below, _mm_set1_epi16(32767));
    const __m128i rate = _mm_insert_epi16(
        _mm_set1_epi16(static_cast<short>(2 * kAdaptationRates.value[seen])), 0, 7);
    __m128i now = _mm_add_epi16(old, _mm_mulhi_epi16(_mm_sub_epi16(target, old), rate));
    now = _mm_sub_epi16(now, _mm_cmpgt_epi16(count_limit(), now));
    _mm_store_si128(reinterpret_cast<__m128i*>(row.v), now);
  }

 private:
  static __m128i load(const uint16_t* v) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(v));
  }

  /// Greater than the count as long as it grows, and than nothing else.
  static __m128i count_limit() {
    return _mm_set_epi16(SymbolRow::kLimit, -1, -1, -1, -1, -1, -1, -1);
  }
};
#elif defined(__wasm_simd128__)
/// The same by vectors of 16 bytes.
struct VectorRows {
  static void mix(const SymbolRow& a, const SymbolRow& b, const SymbolRow& c, uint16_t* to) {
    const v128_t others = wasm_u16x8_avgr(wasm_v128_load(b.v), wasm_v128_load(c.v));
    starts_of(wasm_u16x8_avgr(wasm_v128_load(a.v), others), to);
  }

  static void mix(const SymbolRow* const* rows, const uint16_t* weights, uint16_t* to) {
    const auto row = [&](size_t k) { return wasm_v128_load(rows[k]->v); };
    const auto pair = [&](size_t k) {
      return wasm_i32x4_splat(static_cast<int32_t>(weights[k] | uint32_t{weights[k + 1]} << 16));
    };
    const auto sum = [](v128_t ab, v128_t by_ab, v128_t cd, v128_t by_cd) {
      return wasm_u32x4_shr(
          wasm_i32x4_add(wasm_i32x4_dot_i16x8(ab, by_ab), wasm_i32x4_dot_i16x8(cd, by_cd)),
          kSymbolBits);
    };
    const v128_t a = row(0), b = row(1), c = row(2), d = row(3), by_ab = pair(0), by_cd = pair(2);
    const v128_t low = sum(wasm_i16x8_shuffle(a, b, 0, 8, 1, 9, 2, 10, 3, 11), by_ab,
                           wasm_i16x8_shuffle(c, d, 0, 8, 1, 9, 2, 10, 3, 11), by_cd);
    const v128_t high = sum(wasm_i16x8_shuffle(a, b, 4, 12, 5, 13, 6, 14, 7, 15), by_ab,
                            wasm_i16x8_shuffle(c, d, 4, 12, 5, 13, 6, 14, 7, 15), by_cd);
    starts_of(wasm_i16x8_narrow_i32x4(low, high), to);
  }

  static void starts_of(v128_t mean, uint16_t* to) {
    const v128_t floor = wasm_i16x8_make(8, 16, 24, 32, 40, 48, 56, 0);
    const v128_t starts = wasm_i16x8_add(wasm_i16x8_sub(mean, wasm_u16x8_shr(mean, 9)), floor);
    wasm_v128_store(to, wasm_i16x8_replace_lane(starts, 7, -32768));
  }

  static uint32_t find(const uint16_t* starts, uint32_t x) {
    const v128_t above =
        wasm_i16x8_gt(wasm_v128_load(starts), wasm_i16x8_splat(static_cast<int16_t>(x)));
    return static_cast<uint32_t>(lowest_bit(wasm_i16x8_bitmask(above) | 1U << 7));
  }

  static ANICODEC_INLINE void learn(SymbolRow& row, uint32_t s) {
    const v128_t old = wasm_v128_load(row.v);
    const uint32_t seen = wasm_u16x8_extract_lane(old, 7);
    const v128_t index = wasm_i16x8_make(0, 1, 2, 3, 4, 5, 6, -1);
    const v128_t below = wasm_i16x8_gt(wasm_i16x8_splat(static_cast<int16_t>(s)), index);
    const v128_t error = wasm_i16x8_sub(wasm_v128_andnot(wasm_i16x8_splat(32767), below), old);
    const v128_t rate = wasm_i16x8_replace_lane(
        wasm_i16x8_splat(static_cast<int16_t>(kAdaptationRates.value[seen])), 7, 0);
    const v128_t low = wasm_i32x4_shr(wasm_i32x4_extmul_low_i16x8(error, rate), 15);
    const v128_t high = wasm_i32x4_shr(wasm_i32x4_extmul_high_i16x8(error, rate), 15);
    v128_t now = wasm_i16x8_add(old, wasm_i16x8_narrow_i32x4(low, high));
    const v128_t limit = wasm_i16x8_make(-1, -1, -1, -1, -1, -1, -1, SymbolRow::kLimit);
    now = wasm_i16x8_sub(now, wasm_i16x8_gt(limit, now));
    wasm_v128_store(row.v, now);
  }
};
#else
using VectorRows = PlainRows;
#endif

/// Three rows learn from a symbol, one after the other: they may be the same.
inline void learn_rows(SymbolRow& a, SymbolRow& b, SymbolRow& c, uint32_t s) {
  VectorRows::learn(a, s);
  VectorRows::learn(b, s);
  VectorRows::learn(c, s);
}

/// The distribution that codes the next symbol: the mean of row a, and of the mean of b and c.
class SymbolDistribution {
 public:
  SymbolDistribution(const SymbolRow& a, const SymbolRow& b, const SymbolRow& c) {
    starts_[0] = 0;
    VectorRows::mix(a, b, c, starts_ + 1);
  }

  /// The start of symbol s, in 1/32768; 32768 for s = 8.
  uint32_t start(uint32_t s) const { return starts_[s]; }

  /// The symbol that has x, below 32768.
  uint32_t at(uint32_t x) const { return VectorRows::find(starts_ + 1, x); }

 private:
  uint16_t starts_[kRowSymbols + 1];
};

/// Codes a symbol by three rows, which learn from it one after the other. Inlined, so that the coder
/// stays in registers from symbol to symbol.
template <class Coder>
ANICODEC_INLINE uint32_t code_row_symbol(Coder& coder, SymbolRow& a, SymbolRow& b, SymbolRow& c,
                                         uint32_t s) {
  s = coder.symbol(SymbolDistribution(a, b, c), s);
  if constexpr (Coder::kAdapts)
    learn_rows(a, b, c, s);
  return s;
}

/// The rows of the length of a number, which may take a symbol after the other: up to 28 bits.
using RowNumber = std::array<SymbolRow, 4>;

/// Codes a number from 2^lowest to 2^24 - 1, its length by rows, then the bits below the highest. A
/// decoder that reads a longer one fails and gets 2^lowest.
template <class Coder>
uint32_t code_row_number(Coder& coder, RowNumber& rows, int lowest, uint32_t x) {
  constexpr int kMostBits = 24;
  const int given = floor_log2(x) - lowest;
  int exponent = 0;
  for (SymbolRow& row : rows) {
    const auto left = static_cast<uint32_t>(given > exponent ? given - exponent : 0);
    const uint32_t part =
        code_row_symbol(coder, row, row, row, left < kRowEscape ? left : kRowEscape);
    exponent += static_cast<int>(part);
    if (part < kRowEscape)
      break;
  }
  const int bits = exponent + lowest;
  if (bits >= kMostBits) {
    coder.fail();
    return uint32_t{1} << lowest;
  }
  return uint32_t{1} << bits | coder.raw(bits, x);
}

/// Codes by how much a number is above the symbols of a row: `symbol(s)` tells two classes to an octave up to
/// 44, `far` its exponent from there on, then come the bits below. A decoder gets less than 2^24 + 28, and
/// fails with a number that is too long.
template <class Coder, class Symbol>
inline uint32_t code_row_excess(Coder& coder, const Symbol& symbol, RowNumber& far,
                                uint32_t excess) {
  constexpr uint32_t kFirst = 4, kLast = 48;
  constexpr int kFar = 4;
  const uint32_t x = excess + kFirst;
  const uint32_t s = symbol(x >= kLast ? kRowEscape : magnitude_class<1>(x) - kFirst);
  if (s < kRowEscape) {
    const int bits = static_cast<int>(s / 2) + 1;
    const uint32_t low = (s % 2 + 2) << bits;
    return low + coder.raw(bits, x - low) - kFirst;
  }
  return code_row_number(coder, far, kFar, x - kLast + (1U << kFar)) - (1U << kFar) + kLast -
         kFirst;
}

/// Codes a magnitude below 2^24: 0, or one more than a number whose `low` lowest bits are as good as
/// random. `symbol(s)` and `more(s)` tell the number without these, and its excess. A decoder that reads a
/// larger one fails and gets 0.
template <class Coder, class Symbol, class More>
inline uint32_t code_row_magnitude(Coder& coder, const Symbol& symbol, const More& more,
                                   RowNumber& far, int low, uint32_t magnitude) {
  constexpr int kBits = 24;
  const uint32_t given = magnitude == 0 ? 0 : 1 + ((magnitude - 1) >> low);
  uint32_t high = symbol(given < kRowEscape ? given : kRowEscape);
  if (high == 0)
    return 0;
  if (high == kRowEscape)
    high += code_row_excess(coder, more, far, given - kRowEscape);
  if ((high - 1) >> (kBits - low) != 0) {
    coder.fail();
    return 0;
  }
  return 1 + ((high - 1) << low | coder.raw(low, (magnitude - 1) & ((1U << low) - 1)));
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_SYMBOL_ROW_H_
