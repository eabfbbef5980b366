// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Adaptive binary range coder: 64-bit interval, 32-bit words, 16-bit probabilities
// (spec/08-entropy.md, section 1). After G. N. N. Martin, "Range encoding", 1979; two adaptation
// rates per bit after Alexander, Bossen et al. as used in VVC (Schwarz et al. 2021).
//
// Every model is written once, as a template over the coder: `coder.bit(model, value)` codes
// `value` and returns it; a decoder ignores the argument and returns what it read; a BitCounter
// only adds up what coding would cost. So encoder, decoder and rate estimate cannot drift apart.
#ifndef ANICODEC_FORMAT_CODING_BINARY_CODER_H_
#define ANICODEC_FORMAT_CODING_BINARY_CODER_H_

#include "format/coding/bit_cost.h"
#include "format/memory.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Probability that a bit is 1, in 1/65536, always within [kMinProbability, 65536 -
/// kMinProbability].
constexpr uint32_t kProbabilityOne = 65536;
constexpr uint32_t kMinProbability = 16;

constexpr int kSymbolBits = 15;
constexpr uint32_t kSymbolScale = uint32_t{1} << kSymbolBits;  ///< a symbol's probability of 1

/// Adaptation rate of a probability that has seen n bits, 1 / (n + 1.5), in 1/32768.
struct AdaptationRates {
  static constexpr int kCount = 256;
  int32_t value[kCount] = {};

  constexpr AdaptationRates() {
    for (int n = 0; n < kCount; ++n)
      value[n] = 65536 / (2 * n + 3);
  }
};

inline constexpr AdaptationRates kAdaptationRates{};

/// Adapts to the bits it codes: the mean of a fast (1/16) and a slow (1/128) running average,
/// about. Both start as plain averages of what was seen, so a few dozen bits suffice to learn a
/// probability.
class AdaptiveBit {
 public:
  uint32_t probability() const {
    const uint32_t p = (uint32_t{fast_} + slow_) >> 1;
    return p < kMinProbability                     ? kMinProbability
           : p > kProbabilityOne - kMinProbability ? kProbabilityOne - kMinProbability
                                                   : p;
  }

  void update(bool bit) {
    const int32_t target = bit ? 65535 : 0;
    fast_ = step(fast_, target, kAdaptationRates.value[count_ < kFastLimit ? count_ : kFastLimit]);
    slow_ = step(slow_, target, kAdaptationRates.value[count_]);
    count_ = static_cast<uint8_t>(count_ + (count_ < kSlowLimit));
  }

 private:
  static constexpr int kFastLimit = 14, kSlowLimit = 126;

  static uint16_t step(uint16_t p, int32_t target, int32_t rate) {
    return static_cast<uint16_t>(
        p + (((target - p) * rate) >> 15));  // |product| < 65536 * 21846 < 2^31
  }

  uint16_t fast_ = 32768;
  uint16_t slow_ = 32768;
  uint8_t count_ = 0;
};

/// Writes a stream. Ends with finish(); the object is then spent.
class BinaryEncoder {
 public:
  static constexpr bool kAdapts = true;
  static constexpr bool kDecodes = false;

  /// Codes a bit whose probability of being 1 is p / 65536, 0 < p < 65536.
  bool bit(uint32_t p, bool value) {
    const uint64_t bound = (range_ >> 16) * p;
    if (value) {
      range_ = bound;
    } else {
      add(bound);
      range_ -= bound;
    }
    if (range_ < (uint64_t{1} << 32))
      shift();
    return value;
  }

  bool bit(AdaptiveBit& model, bool value) {
    bit(model.probability(), value);
    model.update(value);
    return value;
  }

  /// Codes the part of a scale of kSymbolScale from `start` to `end`. @pre start < end
  void part(uint32_t start, uint32_t end) {
    const uint64_t unit = range_ >> kSymbolBits;
    add(unit * start);
    range_ = end < kSymbolScale ? unit * (end - start) : range_ - unit * start;
    if (range_ < (uint64_t{1} << 32))
      shift();
  }

  /// Codes symbol s of a distribution.
  template <class Distribution>
  uint32_t symbol(const Distribution& distribution, uint32_t s) {
    part(distribution.start(s), distribution.start(s + 1));
    return s;
  }

  /// The lowest `count` bits of value, highest first, count <= 32, each at one bit.
  uint32_t raw(int count, uint32_t value) {
    for (int i = count - 1; i >= 0; --i)
      bit(kProbabilityOne / 2, (value >> i) & 1);
    return value;
  }

  void fail() {}

  /// Ends the stream with as few bytes as identify it (0 to 8) and hands it over.
  Vector<uint8_t> finish();

  /// Bytes written so far, without those finish() adds.
  size_t size() const { return bytes_.size(); }

 private:
  void add(uint64_t bound) {
    low_ += bound;
    if (low_ < bound)
      carry();
  }

  void carry();
  void shift();

  uint64_t low_ = 0;
  uint64_t range_ = ~uint64_t{0};
  Vector<uint8_t> bytes_;
};

/// Reads a stream of BinaryEncoder. Any bytes are safe: a stream that runs out yields arbitrary
/// bits and ok() turns false; every call takes bounded time.
class BinaryDecoder {
 public:
  static constexpr bool kAdapts = true;
  static constexpr bool kDecodes = true;

  /// Does not copy: `bytes` outlives the decoder. An empty stream is valid.
  BinaryDecoder(const uint8_t* bytes, size_t size);

  bool bit(uint32_t p, bool = false) {
    const uint64_t bound = (range_ >> 16) * p;
    const bool value = code_ < bound;
    if (value) {
      range_ = bound;
    } else {
      code_ -= bound;
      range_ -= bound;
    }
    if (range_ < (uint64_t{1} << 32))
      shift();
    return value;
  }

  bool bit(AdaptiveBit& model, bool = false) {
    const bool value = bit(model.probability());
    model.update(value);
    return value;
  }

  template <class Distribution>
  uint32_t symbol(const Distribution& distribution, uint32_t = 0) {
    const uint64_t unit = range_ >> kSymbolBits, x = code_ / unit;
    const uint32_t s =
        distribution.at(x < kSymbolScale ? static_cast<uint32_t>(x) : kSymbolScale - 1);
    const uint32_t start = distribution.start(s), end = distribution.start(s + 1);
    code_ -= unit * start;
    range_ = end < kSymbolScale ? unit * (end - start) : range_ - unit * start;
    if (range_ < (uint64_t{1} << 32))
      shift();
    return s;
  }

  uint32_t raw(int count, uint32_t = 0) {
    uint32_t value = 0;
    for (int i = 0; i < count; ++i)
      value = value << 1 | static_cast<uint32_t>(bit(kProbabilityOne / 2));
    return value;
  }

  /// False once more was read than any encoder leaves out at the end. Poll it wherever a decoder
  /// would otherwise go on for long.
  bool ok() const { return !failed_; }

  /// Marks the stream as damaged: no encoder writes the bits just read.
  void fail() { failed_ = true; }

  /// True if the stream is exactly what an encoder writes for what was decoded: nothing missing,
  /// nothing left over.
  bool finish() const;

 private:
  void shift();

  uint64_t code_ = 0;
  uint64_t range_ = ~uint64_t{0};
  const uint8_t* bytes_;
  size_t size_;
  size_t position_ = 0;  ///< bytes taken, the zeros that stand for missing ones included
  bool failed_ = false;
};

/// Adds up what coding would take, in 1/65536 bit, and adapts nothing.
class BitCounter {
 public:
  static constexpr bool kAdapts = false;
  static constexpr bool kDecodes = false;

  bool bit(uint32_t p, bool value) {
    total_ += bit_cost(value ? p : kProbabilityOne - p);
    return value;
  }

  bool bit(const AdaptiveBit& model, bool value) { return bit(model.probability(), value); }

  template <class Distribution>
  uint32_t symbol(const Distribution& distribution, uint32_t s) {
    constexpr uint32_t kUnit = kProbabilityOne / kSymbolScale;
    total_ += bit_cost(kUnit * (distribution.start(s + 1) - distribution.start(s)));
    return s;
  }

  uint32_t raw(int count, uint32_t value) {
    total_ += static_cast<uint64_t>(count) * kBitCostOne;
    return value;
  }

  void fail() {}

  uint64_t total() const { return total_; }

 private:
  uint64_t total_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_BINARY_CODER_H_
