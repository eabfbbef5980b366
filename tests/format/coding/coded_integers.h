// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Streams of integers that the tests of the coders share.
#ifndef ANICODEC_TESTS_FORMAT_CODED_INTEGERS_H_
#define ANICODEC_TESTS_FORMAT_CODED_INTEGERS_H_

#include "format/coding/binary_coder.h"
#include "format/coding/symbol_model.h"
#include "tests/random.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace anicodec {

/// Values with many zeros and a few large ones.
inline std::vector<int32_t> skewed(size_t n, uint32_t seed) {
  Random random(seed);
  std::vector<int32_t> v(n);
  for (int32_t& x : v) {
    const uint32_t r = random();
    if (r % 8 == 0)
      x = static_cast<int32_t>(random()) >> (random() % 31);
    if (x == std::numeric_limits<int32_t>::min())
      x = 0;
  }
  return v;
}

/// A stream of them.
inline Vector<uint8_t> encode_integers(const std::vector<int32_t>& values) {
  BinaryEncoder encoder;
  SymbolModel<> model;
  for (const int32_t v : values)
    model.code(encoder, v);
  return encoder.finish();
}

/// Integers of a stream; *exact: nothing else is in it.
inline std::vector<int32_t> decode_integers(const Vector<uint8_t>& bytes, size_t count,
                                            bool* exact) {
  BinaryDecoder decoder(bytes.data(), bytes.size());
  SymbolModel<> model;
  std::vector<int32_t> values(count);
  for (int32_t& v : values)
    v = model.code(decoder);
  *exact = decoder.finish();
  return values;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FORMAT_CODED_INTEGERS_H_
