// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/weighted_rows.h"

#include "format/coding/binary_coder.h"
#include "tests/random.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

// One row knows what comes, the others are drawn.
struct Known {
  SymbolRow rows[8][4];
  RowWeights weights;

  template <class Coder>
  uint32_t code(Coder& coder, uint32_t place, Random& random, uint32_t s) {
    FourRows four = {&rows[place][0], &rows[random() % 8][1], &rows[random() % 8][2],
                     &rows[random() % 8][3]};
    return code_weighted_symbol(coder, four, weights, s);
  }
};

TEST(WeightedRows, TrustTheRowThatKnows) {
  constexpr uint32_t kCount = 5000;
  Known written, read;
  BinaryEncoder encoder;
  Random random(3);
  for (uint32_t i = 0; i < kCount; ++i)
    written.code(encoder, i * i % 8, random, i * i % 8);
  EXPECT_GT(written.weights.w[0], 25000);
  uint32_t sum = 0;
  for (const uint16_t w : written.weights.w) {
    EXPECT_GE(w, 500);
    sum += w;
  }
  EXPECT_LE(sum, kSymbolScale);
  EXPECT_GT(sum, kSymbolScale - 8);
  const Vector<uint8_t> bytes = encoder.finish();
  BinaryDecoder decoder(bytes.data(), bytes.size());
  Random again(3);
  for (uint32_t i = 0; i < kCount; ++i)
    ASSERT_EQ(read.code(decoder, i * i % 8, again, 0), i * i % 8);
  EXPECT_TRUE(decoder.finish());
}

TEST(WeightedRows, KeepEverySymbolPossible) {
  Known known;
  BinaryEncoder encoder;
  for (uint32_t i = 0; i < 20000; ++i) {
    FourRows four = {&known.rows[0][0], &known.rows[1][1], &known.rows[i % 2][2],
                     &known.rows[i % 3][3]};
    code_weighted_symbol(encoder, four, known.weights, i % 1000 == 0 ? 7 : 0);
    const WeightedDistribution distribution(four, known.weights);
    for (uint32_t s = 0; s < kRowSymbols; ++s)
      ASSERT_GE(distribution.start(s + 1), distribution.start(s) + 8);
    ASSERT_EQ(distribution.start(kRowSymbols), kSymbolScale);
  }
}

}  // namespace
}  // namespace anicodec
