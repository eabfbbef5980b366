// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_CODING_SYMBOL_MODEL_H_
#define ANICODEC_FORMAT_CODING_SYMBOL_MODEL_H_

#include "format/coding/binary_coder.h"
#include "format/compiler.h"

#include <cstdint>

namespace anicodec {

/// Position of the highest set bit; 0 for 0.
constexpr int floor_log2(uint32_t x) {
  return x == 0 ? 0 : highest_bit(x);
}

/// How code_symbol treats the sign: values are never negative, it costs one bit, or it is modelled.
enum class Sign { kNone, kRaw, kModelled };

/// Nodes of a symbol's binary decisions: 0 zero flag, 1 sign, 2..21 exponent, 22..63 mantissa.
constexpr int kSymbolNodes = 64;

/// Binarisation of an integer as in Exp-Golomb codes (spec/08-entropy.md, section 2): is it zero;
/// the sign; floor(log2 |v|) in unary; the bits below the leading one, of which the top two are
/// modelled.
///
/// `model(node, bit)` codes a decision with the model of a node, `raw(count, value)` bits at one
/// bit each; both return what was coded. At most 62 decisions, whatever is read.
/// @pre |value| < 2^31
template <Sign kSign, class Model, class Raw>
int32_t code_symbol(int32_t value, Model&& model, Raw&& raw) {
  constexpr int kMaxExponent = 30;
  constexpr uint32_t kZero = 0, kSignNode = 1, kExponent = 2, kMantissa = 22;
  if (!model(kZero, value != 0))
    return 0;
  bool negative = false;
  if constexpr (kSign == Sign::kRaw)
    negative = raw(1, value < 0) != 0;
  else if constexpr (kSign == Sign::kModelled)
    negative = model(kSignNode, value < 0);
  const uint32_t magnitude =
      value < 0 ? 0u - static_cast<uint32_t>(value) : static_cast<uint32_t>(value);
  const int wanted = floor_log2(magnitude);
  int exponent = 0;
  while (exponent < kMaxExponent &&
         model(kExponent + static_cast<uint32_t>(exponent < 19 ? exponent : 19), wanted > exponent))
    ++exponent;
  uint32_t m = 1;
  if (exponent > 0) {
    const uint32_t base =
        kMantissa + 3 * static_cast<uint32_t>((exponent < 14 ? exponent : 14) - 1);
    m = 2 + uint32_t{model(base, (magnitude >> (exponent - 1)) & 1)};
    if (exponent > 1)
      m = m << 1 | uint32_t{model(base + 1 + (m & 1), (magnitude >> (exponent - 2)) & 1)};
    if (exponent > 2)
      m = m << (exponent - 2) | raw(exponent - 2, magnitude & ((1u << (exponent - 2)) - 1));
  }
  return negative ? -static_cast<int32_t>(m) : static_cast<int32_t>(m);
}

/// Adaptive model of the integers of one kind, for side information: any |v| < 2^31, small ones
/// cheap.
template <Sign kSign = Sign::kRaw>
class SymbolModel {
 public:
  /// Encoder: codes value. Decoder: ignores it and returns what was read. BitCounter: adds what it
  /// would take.
  template <class Coder>
  int32_t code(Coder& coder, int32_t value = 0) {
    return code_symbol<kSign>(
        value, [&](uint32_t node, bool bit) { return coder.bit(bits_[node], bit); },
        [&](int count, uint32_t bits) { return coder.raw(count, bits); });
  }

 private:
  AdaptiveBit bits_[kSymbolNodes];
};

/// For integers that are never negative.
using UnsignedModel = SymbolModel<Sign::kNone>;

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_SYMBOL_MODEL_H_
