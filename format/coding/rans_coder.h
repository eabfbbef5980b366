// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Range asymmetric numeral system with four states that take turns: the decisions of a stream do not
// wait for one another (spec/08-entropy.md, section 5). After J. Duda, "Asymmetric numeral systems",
// 2013, and F. Giesen, "Interleaved entropy coders", 2014.
//
// Models are written once, as templates over the coder, as for BinaryEncoder and BinaryDecoder.
#ifndef ANICODEC_FORMAT_CODING_RANS_CODER_H_
#define ANICODEC_FORMAT_CODING_RANS_CODER_H_

#include "format/bytes.h"
#include "format/coding/binary_coder.h"
#include "format/compiler.h"
#include "format/memory.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// States of a stream; decision i belongs to state i mod kRansStates.
constexpr size_t kRansStates = 4;
/// The state before the first decision of an encoder, and after the last one of a decoder.
constexpr uint32_t kRansStart = uint32_t{1} << 16;

/// Codes the lowest `count` bits of a value, count <= 32, as decisions of at most 12 bits, the highest
/// first: `raw(bits, value)` codes one and returns it.
template <class Raw>
inline uint32_t code_raw_bits(int count, uint32_t value, Raw&& raw) {
  constexpr int kMost = 12;
  uint32_t coded = 0;
  for (int left = count; left > 0;) {
    const int bits = (left - 1) % kMost + 1;
    left -= bits;
    coded = coded << bits | raw(bits, value >> left & ((1U << bits) - 1));
  }
  return coded;
}

/// Takes decisions in the order of a decoder and writes them, last first, in finish(). The object is
/// then spent. Memory: 4 bytes for each decision.
class RansEncoder {
 public:
  static constexpr bool kAdapts = true;
  static constexpr bool kDecodes = false;

  template <class Distribution>
  uint32_t symbol(const Distribution& distribution, uint32_t s) {
    add(distribution.start(s), distribution.start(s + 1) - distribution.start(s));
    return s;
  }

  bool bit(AdaptiveBit& model, bool value) {
    const uint32_t one = model.probability() >> 1;
    value ? add(0, one) : add(one, kSymbolScale - one);
    model.update(value);
    return value;
  }

  /// The lowest `count` bits of value, count <= 32, highest first.
  uint32_t raw(int count, uint32_t value) {
    return code_raw_bits(count, value, [this](int bits, uint32_t x) {
      add(x << (kSymbolBits - bits), kSymbolScale >> bits);
      return x;
    });
  }

  bool ok() const { return true; }

  void fail() {}

  Bytes finish();

 private:
  void add(uint32_t start, uint32_t size) { decisions_.push_back(start << 16 | size); }

  Vector<uint32_t> decisions_;  ///< of each, where its part of the scale starts, and its size
};

/// Reads a stream of RansEncoder. Any bytes are safe: a stream that runs out yields arbitrary symbols
/// and ok() turns false; every call takes bounded time.
class RansDecoder {
 public:
  static constexpr bool kAdapts = true;
  static constexpr bool kDecodes = true;

  /// The bytes must outlive the object.
  explicit RansDecoder(ByteView bytes);

  template <class Distribution>
  uint32_t symbol(const Distribution& distribution, uint32_t = 0) {
    uint32_t& state = next();
    const uint32_t s = distribution.at(state % kSymbolScale);
    advance(state, distribution.start(s), distribution.start(s + 1) - distribution.start(s));
    return s;
  }

  bool bit(AdaptiveBit& model, bool = false) {
    uint32_t& state = next();
    const uint32_t one = model.probability() >> 1;
    const bool value = state % kSymbolScale < one;
    value ? advance(state, 0, one) : advance(state, one, kSymbolScale - one);
    model.update(value);
    return value;
  }

  uint32_t raw(int count, uint32_t = 0) {
    return code_raw_bits(count, 0, [this](int bits, uint32_t) {
      uint32_t& state = next();
      const int unused = kSymbolBits - bits;
      const uint32_t value = state % kSymbolScale >> unused;
      advance(state, value << unused, kSymbolScale >> bits);
      return value;
    });
  }

  /// False once the stream has run out.
  bool ok() const { return position_ <= words_; }

  /// A symbol that no encoder writes was read.
  void fail() { position_ = words_ + 1; }

  /// Whether the stream is exactly what an encoder writes for the decisions read.
  bool finish() const;

 private:
  ANICODEC_INLINE uint32_t& next() { return states_[turn_++ % kRansStates]; }

  ANICODEC_INLINE void advance(uint32_t& state, uint32_t start, uint32_t size) {
    state = size * (state / kSymbolScale) + state % kSymbolScale - start;
    if (state < kRansStart) {
      uint32_t word = 0;
      if (position_ < words_)
        word = bytes_[2 * position_] | uint32_t{bytes_[2 * position_ + 1]} << 8;
      ++position_;
      state = state << 16 | word;
    }
  }

  std::array<uint32_t, kRansStates> states_{};
  size_t turn_ = 0;
  const uint8_t* bytes_ = nullptr;
  size_t words_ = 0, position_ = 0;  ///< of 16 bits, behind the states
  bool begun_ = false;               ///< the states are there and in their range
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_RANS_CODER_H_
