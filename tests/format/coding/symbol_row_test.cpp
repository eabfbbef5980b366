// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/symbol_row.h"

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
      const SymbolRow second = learnt<PlainRows>(seed + 1, count);
      std::array<uint16_t, 8> a{}, b{};
      PlainRows::mix(plain, second, a.data());
      VectorRows::mix(plain, second, b.data());
      ASSERT_EQ(a, b);
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
    const SymbolDistribution distribution(row, row);
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

}  // namespace
}  // namespace anicodec
