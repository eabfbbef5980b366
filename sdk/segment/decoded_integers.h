// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The integers that a segment is decoded to: hashed, and shown step by step to whoever compares
// decoders (tests/conformance).
#ifndef ANICODEC_SDK_SEGMENT_DECODED_INTEGERS_H_
#define ANICODEC_SDK_SEGMENT_DECODED_INTEGERS_H_

#include "format/checksum.h"
#include "format/memory.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Nobody looks at a decoder that is to be small.
#if defined(ANICODEC_SMALL)
constexpr bool kTraces = false;
#else
constexpr bool kTraces = true;
#endif

/// Receives the integers of each step of decoding, in the order of the specification.
class DecodingTrace {
 public:
  virtual ~DecodingTrace() = default;

  /// `name` is of static duration; a step may come in several calls.
  virtual void step(const char* name, const int32_t* values, size_t count) = 0;
};

/// Shows unsigned integers, which are below 2^31.
inline void show(DecodingTrace* trace, const char* name, const Vector<uint32_t>& values) {
  if (!kTraces || !trace)
    return;
  const Vector<int32_t> copy(values.begin(), values.end());
  trace->step(name, copy.data(), copy.size());
}

/// Hashes what the encoder hashed too, and shows it, if anyone looks.
class DecodedIntegers {
 public:
  explicit DecodedIntegers(DecodingTrace* trace) : trace_(trace) {}

  void add(const char* name, const int32_t* values, size_t count) {
    hash_.add(values, count);
    show(name, values, count);
  }

  /// Adds the hash of integers in place of them, its lower half first.
  void add_block(const IntegerHash& block) {
    const uint64_t digest = block.digest();
    const int32_t halves[2] = {static_cast<int32_t>(digest & 0xFFFFFFFF),
                               static_cast<int32_t>(digest >> 32)};
    hash_.add(halves, 2);
  }

  /// Integers that the hash does not contain.
  void show(const char* name, const int32_t* values, size_t count) const {
    if (kTraces && trace_)
      trace_->step(name, values, count);
  }

  uint64_t digest() const { return hash_.digest(); }

 private:
  IntegerHash hash_;
  DecodingTrace* trace_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_DECODED_INTEGERS_H_
