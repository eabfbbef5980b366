// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/student_mixture.h"

#include "format/bit_cost.h"

#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

StudentMixture mixture(std::initializer_list<std::pair<double, double>> parts) {
  StudentMixture m;
  for (auto [mean, scale] : parts)
    m.add(mean, scale);
  return m;
}

void expect_round_trip(const StudentMixture& m, const std::vector<int32_t>& values) {
  BinaryEncoder encoder;
  MixtureWeights to;
  for (int32_t v : values)
    to.code(encoder, m, v);
  Vector<uint8_t> bytes = encoder.finish();
  BinaryDecoder decoder(bytes.data(), bytes.size());
  MixtureWeights from;
  for (int32_t v : values)
    ASSERT_EQ(from.code(decoder, m, 0), v);
  EXPECT_TRUE(decoder.finish());
}

const std::vector<int32_t> kValues = {
    0, 1, -1, 7, -300, 12345, -(1 << 20), 1 << 24, INT32_MAX, INT32_MIN, INT32_MAX - 1, 0};

TEST(StudentMixture, IntegersOfAnySizeComeBack) {
  expect_round_trip(mixture({{0, 1}, {100, 30}}), kValues);
  expect_round_trip(mixture({{1e9, 1e-3}}), kValues);
}

TEST(StudentMixture, NumbersOutOfRangeAreReplaced) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  expect_round_trip(mixture({{nan, nan}, {infinite, -1}, {-1e300, infinite}, {3, 0}}), kValues);
}

TEST(StudentMixture, ItsDistributionFunctionRisesFromZeroToOne) {
  StudentMixture m = mixture({{5, 2}});
  EXPECT_NEAR(m.below(0, -1e7), 0, 1e-12);
  EXPECT_DOUBLE_EQ(m.below(0, 5), 0.5);
  EXPECT_NEAR(m.below(0, 5 + 2 * 2.776), 0.975, 1e-4);  // from a table of the distribution
  EXPECT_NEAR(m.below(0, 1e7), 1, 1e-12);
}

TEST(StudentMixture, GoodPredictionsBecomeHeavy) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int32_t> value(-1000000, 1000000), error(-2, 2);
  MixtureWeights weights;
  BinaryEncoder encoder;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    int32_t v = value(random);
    weights.code(encoder, mixture({{0, 5e5}, {double(v + error(random)), 1.5}}), v);
  }
  EXPECT_LT(static_cast<double>(encoder.size()) * 8 / kCount, 3.2);
}

TEST(StudentMixture, CodingEndsOnAStreamThatHasRunOut) {
  BinaryDecoder decoder(nullptr, 0);
  MixtureWeights weights;
  for (int i = 0; i < 100; ++i)
    weights.code(decoder, mixture({{0, 1}}), 0);
  EXPECT_FALSE(decoder.ok());
}

}  // namespace
}  // namespace anicodec
