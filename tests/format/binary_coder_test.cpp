// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/binary_coder.h"

#include "format/symbol_model.h"
#include "tests/random.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Bytes = Vector<uint8_t>;

// Values with many zeros and a few large ones. No std:: distribution: their results differ by
// library.
std::vector<int32_t> skewed(size_t n, uint32_t seed) {
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

Bytes encode(const std::vector<int32_t>& values) {
  BinaryEncoder encoder;
  SymbolModel<> model;
  for (const int32_t v : values)
    model.code(encoder, v);
  return encoder.finish();
}

std::vector<int32_t> decode(const Bytes& bytes, size_t count, bool* exact) {
  BinaryDecoder decoder(bytes.data(), bytes.size());
  SymbolModel<> model;
  std::vector<int32_t> values(count);
  for (int32_t& v : values)
    v = model.code(decoder);
  *exact = decoder.finish();
  return values;
}

void expect_round_trip(const std::vector<int32_t>& values) {
  const Bytes bytes = encode(values);
  bool exact = false;
  EXPECT_EQ(decode(bytes, values.size(), &exact), values);
  EXPECT_TRUE(exact);
}

TEST(BinaryCoder, ReturnsRandomBitsOfEveryProbability) {
  Random random(1);
  std::vector<uint32_t> p(100000);
  std::vector<bool> bits(p.size());
  BinaryEncoder encoder;
  for (size_t i = 0; i < p.size(); ++i) {
    const uint32_t kind = random() % 4;
    p[i] = kind == 0 ? 1 : kind == 1 ? 65535 : 1 + random() % 65535;
    bits[i] = random() % 65536 < p[i];
    encoder.bit(p[i], bits[i]);
  }
  const Bytes bytes = encoder.finish();
  BinaryDecoder decoder(bytes.data(), bytes.size());
  for (size_t i = 0; i < p.size(); ++i)
    ASSERT_EQ(decoder.bit(p[i]), bits[i]) << i;
  EXPECT_TRUE(decoder.finish());
}

TEST(BinaryCoder, ReturnsTheImprobable) {
  for (const bool value : {false, true}) {
    BinaryEncoder encoder;
    for (int i = 0; i < 5000; ++i)
      encoder.bit(value ? 1 : 65535, value);
    const Bytes bytes = encoder.finish();
    EXPECT_NEAR(static_cast<double>(bytes.size()), 10000, 2);
    BinaryDecoder decoder(bytes.data(), bytes.size());
    for (int i = 0; i < 5000; ++i)
      ASSERT_EQ(decoder.bit(value ? 1u : 65535u), value);
    EXPECT_TRUE(decoder.finish());
  }
}

TEST(BinaryCoder, CarriesThroughRunsOfFullBytes) {
  // Zeros of a probability of nearly one half keep low just under a power of two for long.
  for (int length = 0; length < 200; ++length) {
    BinaryEncoder encoder;
    encoder.bit(32768, true);
    for (int i = 0; i < length; ++i)
      encoder.bit(32768, false);
    for (int i = 0; i < length; ++i)
      encoder.bit(65535, i % 3 != 0);
    const Bytes bytes = encoder.finish();
    BinaryDecoder decoder(bytes.data(), bytes.size());
    ASSERT_TRUE(decoder.bit(32768));
    for (int i = 0; i < length; ++i)
      ASSERT_FALSE(decoder.bit(32768));
    for (int i = 0; i < length; ++i)
      ASSERT_EQ(decoder.bit(65535), i % 3 != 0);
    EXPECT_TRUE(decoder.finish());
  }
}

TEST(BinaryCoder, EndsWithFewBytes) {
  EXPECT_EQ(BinaryEncoder().finish(), Bytes());
  EXPECT_THAT(encode({0}).size(), testing::Le(1u));
  EXPECT_THAT(encode(std::vector<int32_t>(100, 0)).size(), testing::Le(2u));
  EXPECT_THAT(encode({1}).size(), testing::Le(1u));
  EXPECT_THAT(encode(std::vector<int32_t>(100000, 0)).size(), testing::Le(60u));
}

TEST(BinaryCoder, StaysWithinHalfAByteOfTheProbabilities) {
  Random random(3);
  for (size_t n = 0; n < 300; ++n) {
    BinaryEncoder encoder;
    double bits = 0;
    for (size_t i = 0; i < n; ++i) {
      const uint32_t p = 1 + random() % 65535;
      const bool b = random() % 65536 < p;
      bits -= std::log2((b ? p : 65536 - p) / 65536.0);
      encoder.bit(p, b);
    }
    EXPECT_LE(static_cast<double>(encoder.finish().size()), bits / 8 + 1.5);
  }
}

TEST(BinaryCoder, RejectsLeftOverBytes) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const std::vector<int32_t> values = skewed(seed * 30, seed);
    for (const uint8_t extra : Bytes{0, 1, 128, 255}) {
      Bytes bytes = encode(values);
      for (int i = 0; i < 40; ++i) {
        bytes.push_back(extra);
        bool exact = true;
        const std::vector<int32_t> read = decode(bytes, values.size(), &exact);
        EXPECT_FALSE(exact && read == values) << i << " bytes of " << int{extra};
      }
    }
  }
}

TEST(BinaryCoder, AcceptsOnlyWhatAnEncoderWrites) {
  Random random(9);
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes(random() % 12);
    for (uint8_t& b : bytes)
      b = static_cast<uint8_t>(random() % 4 ? random() : 0);
    bool exact = false;
    const std::vector<int32_t> values = decode(bytes, 1 + random() % 12, &exact);
    EXPECT_EQ(exact, encode(values) == bytes);
    accepted += exact;
  }
  EXPECT_GT(accepted, 10);
}

TEST(BinaryCoder, NoticesThatAStreamRanOut) {
  const std::vector<int32_t> values = skewed(1000, 6);
  const Bytes bytes = encode(values);
  for (size_t kept = 0; kept + 8 < bytes.size(); ++kept) {
    BinaryDecoder decoder(bytes.data(), kept);
    SymbolModel<> model;
    std::vector<int32_t> read;
    while (decoder.ok() && read.size() < 100 * values.size())
      read.push_back(model.code(decoder));
    EXPECT_FALSE(decoder.ok() && decoder.finish()) << kept;
  }
}

TEST(BinaryCoder, SurvivesAnyBytes) {
  Random random(7);
  for (int round = 0; round < 3000; ++round) {
    Bytes bytes(random() % 40);
    const uint32_t kind = random() % 3;
    for (uint8_t& b : bytes)
      b = static_cast<uint8_t>(kind == 0 ? 255 : kind == 1 ? random() : 255 * (random() % 2));
    bool exact = false;
    decode(bytes, 500, &exact);
    BinaryDecoder decoder(bytes.data(), bytes.size());
    for (int i = 0; i < 2000; ++i)
      decoder.bit(1 + random() % 65535);
  }
}

TEST(BinaryCoder, CountsWhatTheEncoderWrites) {
  BinaryEncoder encoder;
  SymbolModel<> model;
  uint64_t total = 0;
  for (const int32_t v : skewed(20000, 8)) {
    BitCounter counter;
    model.code(counter, v);
    total += counter.total();
    model.code(encoder, v);
  }
  EXPECT_NEAR(static_cast<double>(total) / kBitCostOne / 8,
              static_cast<double>(encoder.finish().size()), 20);
}

TEST(BitCost, IsTheLogarithm) {
  for (uint32_t p = 1; p <= 65536; ++p)
    ASSERT_NEAR(bit_cost(p) / 65536.0, -std::log2(p / 65536.0), 0.001) << p;
}

TEST(SymbolModel, ReturnsSkewedAndExtremeValues) {
  constexpr int32_t kMax = std::numeric_limits<int32_t>::max();
  expect_round_trip({});
  expect_round_trip({0});
  expect_round_trip({kMax, -kMax, 0, 1, -1, kMax, 2, -2, 3, -3, 4, 1 << 30, -(1 << 30)});
  expect_round_trip(std::vector<int32_t>(10000, 0));
  expect_round_trip(std::vector<int32_t>(3000, -kMax));
  for (uint32_t seed = 0; seed < 20; ++seed)
    expect_round_trip(skewed(seed * 300, seed));
  std::vector<int32_t> alternating(2000);
  for (size_t i = 0; i < alternating.size(); ++i)
    alternating[i] = i % 2 ? 1 << (i % 31) : 0;
  expect_round_trip(alternating);
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
  const Bytes whole = encode(values);
  bool exact = false;
  for (size_t kept = 0; kept < whole.size(); ++kept)
    decode(Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(kept)), values.size(),
           &exact);
  Random random(12);
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes = whole;
    for (uint32_t i = random() % 4 + 1; i > 0; --i)
      bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
    decode(bytes, values.size(), &exact);
  }
}

// The bytes that spec/08-entropy.md cites.
TEST(SymbolModel, WritesTheBytesOfTheSpecification) {
  std::vector<int32_t> values;
  for (int32_t i = 0; i < 40; ++i)
    values.push_back(i % 3 == 0 ? i * i * (i % 2 ? -1 : 1) : i % 5 - 2);
  Bytes bytes = encode(values);
  std::string hex;
  for (const uint8_t b : bytes) {
    constexpr char kDigits[] = "0123456789abcdef";
    hex += {kDigits[b >> 4], kDigits[b & 15]};
  }
  EXPECT_EQ(hex, "88049a424faff8560e66e534014c9972dfb17e613d181fa545648bcf0204d1a3910c88a0");
}

}  // namespace
}  // namespace anicodec
