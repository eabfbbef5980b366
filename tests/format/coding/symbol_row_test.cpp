// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/symbol_row.h"

#include "format/coding/binary_coder.h"
#include "format/memory.h"
#include "tests/random.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Rows that have learnt anything, by the arithmetic at hand.
template <class Rows>
SymbolRow learnt(uint32_t seed, int count) {
  Random random(seed);
  SymbolRow row;
  row.start(random() % 4000, 1 + random() % 4000);
  for (int i = 0; i < count; ++i)
    Rows::learn(row, random() % (seed % 2 ? 8 : 2));
  return row;
}

TEST(SymbolRow, IsTheSameByVectors) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    for (const int count : {0, 1, 40}) {
      const SymbolRow plain = learnt<PlainRows>(seed, count),
                      other = learnt<VectorRows>(seed, count);
      ASSERT_TRUE(std::equal(plain.v, plain.v + 8, other.v));
      const SymbolRow second = learnt<PlainRows>(seed + 1, count),
                      third = learnt<PlainRows>(seed + 2, count);
      std::array<uint16_t, 8> a{}, b{};
      PlainRows::mix(plain, second, third, a.data());
      VectorRows::mix(plain, second, third, b.data());
      ASSERT_EQ(a, b);
      const SymbolRow* const four[] = {&plain, &second, &third, &other};
      const uint16_t weights[] = {static_cast<uint16_t>(500 + 150 * seed), 600, 1700,
                                  static_cast<uint16_t>(32767 - 2800 - 150 * seed)};
      std::array<uint16_t, 8> c{}, d{};
      PlainRows::mix(four, weights, c.data());
      VectorRows::mix(four, weights, d.data());
      ASSERT_EQ(c, d);
      for (uint32_t x = 0; x < kSymbolScale; x += 1 + seed % 13)
        ASSERT_EQ(PlainRows::find(a.data(), x), VectorRows::find(a.data(), x));
    }
  }
}

TEST(SymbolRow, LeavesEverySymbolPossible) {
  for (uint32_t only = 0; only < kRowSymbols; ++only) {
    SymbolRow row;
    for (int i = 0; i < 1000; ++i)
      VectorRows::learn(row, only);
    const SymbolDistribution distribution(row, row, row);
    EXPECT_EQ(distribution.start(0), 0U);
    EXPECT_EQ(distribution.start(8), kSymbolScale);
    for (uint32_t s = 0; s < kRowSymbols; ++s) {
      EXPECT_GE(distribution.start(s + 1), distribution.start(s) + 8);
      EXPECT_EQ(distribution.at(distribution.start(s)), s);
      EXPECT_EQ(distribution.at(distribution.start(s + 1) - 1), s);
    }
    EXPECT_GT(distribution.start(only + 1) - distribution.start(only), kSymbolScale * 9 / 10);
  }
}

TEST(SymbolRow, StartsAsAGeometricSequence) {
  SymbolRow row;
  row.start(1, 1);
  EXPECT_EQ(row.v[0], 16384);
  EXPECT_EQ(row.v[1], 24576);
  EXPECT_EQ(row.v[6], 32512);
}

/// Rows that code magnitudes among bits.
struct Rows {
  SymbolRow a, b, c, more_a, more_b, more_c;
  RowNumber far;
  AdaptiveBit bit;

  template <class Coder>
  uint32_t code(Coder& coder, int low, uint32_t value) {
    const auto symbol = [&](uint32_t s) { return code_row_symbol(coder, a, b, c, s); };
    const auto more = [&](uint32_t s) { return code_row_symbol(coder, more_a, more_b, more_c, s); };
    return code_row_magnitude(coder, symbol, more, far, low, value);
  }
};

// The binary range coder takes symbols among its bits.
TEST(SymbolRow, IsCodedAmongBits) {
  constexpr int kCount = 20000;
  const auto value_of = [](Random& random) { return random() % (random() % 50 ? 4 : 1U << 24); };
  const auto low_of = [](int i) { return i % 7 == 0 ? 3 : 0; };
  Random random(5);
  Rows written;
  BinaryEncoder encoder;
  uint64_t counted = 0;
  for (int i = 0; i < kCount; ++i) {
    const uint32_t value = value_of(random);
    BitCounter counter;
    written.code(counter, low_of(i), value);
    counter.bit(written.bit, value % 2 != 0);
    counted += counter.total();
    written.code(encoder, low_of(i), value);
    encoder.bit(written.bit, value % 2 != 0);
  }
  const Vector<uint8_t> bytes = encoder.finish();
  EXPECT_NEAR(static_cast<double>(counted) / kBitCostOne / 8, static_cast<double>(bytes.size()),
              20);
  Random again(5);
  Rows read;
  BinaryDecoder decoder(bytes.data(), bytes.size());
  for (int i = 0; i < kCount; ++i) {
    const uint32_t value = value_of(again);
    ASSERT_EQ(read.code(decoder, low_of(i), 0), value) << i;
    ASSERT_EQ(decoder.bit(read.bit), value % 2 != 0) << i;
  }
  EXPECT_TRUE(decoder.finish());
}

TEST(SymbolRow, SurvivesAnyBytesOfTheBinaryCoder) {
  Random random(6);
  for (int round = 0; round < 2000; ++round) {
    Vector<uint8_t> bytes(random() % 40);
    const uint32_t kind = random() % 3;
    for (uint8_t& b : bytes)
      b = static_cast<uint8_t>(kind == 0 ? 255 : kind == 1 ? random() : 255 * (random() % 2));
    BinaryDecoder decoder(bytes.data(), bytes.size());
    SymbolRow a, b, c;
    RowNumber far;
    const auto symbol = [&](uint32_t s) { return code_row_symbol(decoder, a, b, c, s); };
    for (int i = 0; i < 500; ++i)
      ASSERT_LE(code_row_magnitude(decoder, symbol, symbol, far, i % 14, 0), 1U << 24);
    (void)decoder.finish();
  }
}

}  // namespace
}  // namespace anicodec
