// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/binary_coder.h"

#include "format/coding/symbol_model.h"
#include "tests/format/coding/coded_integers.h"
#include "tests/random.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Bytes = Vector<uint8_t>;

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
  EXPECT_THAT(encode_integers({0}).size(), testing::Le(1u));
  EXPECT_THAT(encode_integers(std::vector<int32_t>(100, 0)).size(), testing::Le(2u));
  EXPECT_THAT(encode_integers({1}).size(), testing::Le(1u));
  EXPECT_THAT(encode_integers(std::vector<int32_t>(100000, 0)).size(), testing::Le(60u));
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
      Bytes bytes = encode_integers(values);
      for (int i = 0; i < 40; ++i) {
        bytes.push_back(extra);
        bool exact = true;
        const std::vector<int32_t> read = decode_integers(bytes, values.size(), &exact);
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
    const std::vector<int32_t> values = decode_integers(bytes, 1 + random() % 12, &exact);
    EXPECT_EQ(exact, encode_integers(values) == bytes);
    accepted += exact;
  }
  EXPECT_GT(accepted, 10);
}

TEST(BinaryCoder, NoticesThatAStreamRanOut) {
  const std::vector<int32_t> values = skewed(1000, 6);
  const Bytes bytes = encode_integers(values);
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
    decode_integers(bytes, 500, &exact);
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

}  // namespace
}  // namespace anicodec
