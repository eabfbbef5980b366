// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/symbol_model.h"

#include "format/coding/binary_coder.h"
#include "tests/format/coding/coded_integers.h"
#include "tests/random.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Bytes = Vector<uint8_t>;

void expect_values_round_trip(const std::vector<int32_t>& values) {
  const Bytes bytes = encode_integers(values);
  bool exact = false;
  EXPECT_EQ(decode_integers(bytes, values.size(), &exact), values);
  EXPECT_TRUE(exact);
}

TEST(SymbolModel, ReturnsSkewedAndExtremeValues) {
  constexpr int32_t kMax = std::numeric_limits<int32_t>::max();
  expect_values_round_trip({});
  expect_values_round_trip({0});
  expect_values_round_trip({kMax, -kMax, 0, 1, -1, kMax, 2, -2, 3, -3, 4, 1 << 30, -(1 << 30)});
  expect_values_round_trip(std::vector<int32_t>(10000, 0));
  expect_values_round_trip(std::vector<int32_t>(3000, -kMax));
  for (uint32_t seed = 0; seed < 20; ++seed)
    expect_values_round_trip(skewed(seed * 300, seed));
  std::vector<int32_t> alternating(2000);
  for (size_t i = 0; i < alternating.size(); ++i)
    alternating[i] = i % 2 ? 1 << (i % 31) : 0;
  expect_values_round_trip(alternating);
}

TEST(SymbolModel, CodesUnsignedValuesWithoutASign) {
  BinaryEncoder encoder, plain;
  UnsignedModel model;
  SymbolModel<> with_sign;
  for (int32_t i = 0; i < 1000; ++i) {
    model.code(encoder, i % 50);
    with_sign.code(plain, i % 50);
  }
  const Bytes bytes = encoder.finish();
  EXPECT_NEAR(static_cast<double>(bytes.size()),
              static_cast<double>(plain.finish().size()) - 980 / 8.0, 2);
  BinaryDecoder decoder(bytes.data(), bytes.size());
  UnsignedModel again;
  for (int32_t i = 0; i < 1000; ++i)
    ASSERT_EQ(again.code(decoder), i % 50);
  EXPECT_TRUE(decoder.finish());
}

TEST(SymbolModel, LearnsTheSign) {
  BinaryEncoder encoder;
  SymbolModel<Sign::kModelled> model;
  for (int i = 0; i < 8000; ++i)
    model.code(encoder, -1);
  EXPECT_LT(encoder.finish().size(), 20u);
}

TEST(SymbolModel, TruncatedOrCorruptStreamsEndInTime) {
  const std::vector<int32_t> values = skewed(300, 11);
  const Bytes whole = encode_integers(values);
  bool exact = false;
  for (size_t kept = 0; kept < whole.size(); ++kept)
    decode_integers(Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(kept)),
                    values.size(), &exact);
  Random random(12);
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes = whole;
    for (uint32_t i = random() % 4 + 1; i > 0; --i)
      bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
    decode_integers(bytes, values.size(), &exact);
  }
}

// The bytes that spec/08-entropy.md cites.
TEST(SymbolModel, WritesTheBytesOfTheSpecification) {
  std::vector<int32_t> values;
  for (int32_t i = 0; i < 40; ++i)
    values.push_back(i % 3 == 0 ? i * i * (i % 2 ? -1 : 1) : i % 5 - 2);
  Bytes bytes = encode_integers(values);
  std::string hex;
  for (const uint8_t b : bytes) {
    constexpr char kDigits[] = "0123456789abcdef";
    hex += {kDigits[b >> 4], kDigits[b & 15]};
  }
  EXPECT_EQ(hex, "88049a424faff8560e66e534014c9972dfb17e613d181fa545648bcf0204d1a3910c88a0");
}

}  // namespace
}  // namespace anicodec
