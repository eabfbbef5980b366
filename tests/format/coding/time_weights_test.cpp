// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/time_weights.h"

#include "format/coding/cosine_transform.h"
#include "tests/random.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Bytes = Vector<uint8_t>;

constexpr uint32_t kAll = (1u << kWeightPredictors) - 1;
constexpr double kPi = 3.14159265358979323846;

struct Component {
  uint32_t channels;
  std::vector<double> x;
};

struct Coded {
  Bytes bytes;
  std::vector<std::vector<int32_t>> values;
  std::vector<WeightPredictor> predictors;
};

// Sums of a few waves and some noise.
std::vector<Component> smooth(uint32_t frames, uint32_t components, double size, uint32_t seed) {
  Random random(seed);
  std::vector<Component> result;
  for (uint32_t j = 0; j < components; ++j) {
    Component c{j % 4 == 3 ? 1u : 3u, {}};
    for (uint32_t d = 0; d < c.channels; ++d) {
      const double wave = 1 + random() % 9, phase = random() % 100;
      for (uint32_t f = 0; f < frames; ++f)
        c.x.push_back(size / (j + 1) * std::sin(wave * kPi * f / frames + phase) +
                      static_cast<double>(random() % 1000) / 1000);
    }
    result.push_back(std::move(c));
  }
  return result;
}

class TimeWeights : public testing::Test {
 protected:
  static Coded encode(uint32_t frames, const std::vector<Component>& components,
                      uint32_t allowed = kAll, double lambda = 0.1) {
    Coded coded;
    BinaryEncoder encoder;
    TimeWeightModel model(frames);
    for (const Component& c : components) {
      coded.values.emplace_back(c.x.size());
      coded.predictors.push_back(
          model.encode(encoder, c.channels, c.x.data(), lambda, coded.values.back().data(), allowed)
              .predictor);
    }
    coded.bytes = encoder.finish();
    return coded;
  }

  // False if decoding reports an error.
  static bool decode(uint32_t frames, const std::vector<Component>& components, const Bytes& bytes,
                     std::vector<std::vector<int32_t>>* values) {
    BinaryDecoder decoder(bytes.data(), bytes.size());
    TimeWeightModel model(frames);
    values->clear();
    for (const Component& c : components) {
      values->emplace_back(c.x.size());
      if (model.decode(decoder, c.channels, values->back().data()) != Status::kOk)
        return false;
    }
    return decoder.finish();
  }

  static void expect_round_trip(uint32_t frames, const std::vector<Component>& components,
                                uint32_t allowed) {
    const Coded coded = encode(frames, components, allowed);
    std::vector<std::vector<int32_t>> values;
    EXPECT_TRUE(decode(frames, components, coded.bytes, &values))
        << frames << " frames, " << allowed;
    EXPECT_EQ(values, coded.values);
    if (allowed >> static_cast<uint32_t>(WeightPredictor::kCosine))
      return;
    for (size_t j = 0; j < components.size(); ++j)
      for (size_t i = 0; i < components[j].x.size(); ++i)
        ASSERT_NEAR(coded.values[j][i] / 16.0, components[j].x[i], 2.01);
  }
};

TEST_F(TimeWeights, ReturnsWhatTheEncoderSaw) {
  for (const uint32_t frames : {0u, 1u, 2u, 3u, 4u, 5u, 63u, 64u, 65u, 127u, 128u, 129u, 200u})
    for (uint32_t p = 0; p < kWeightPredictors; ++p)
      expect_round_trip(frames, smooth(frames, 6, 100, frames), 1u << p);
  expect_round_trip(150, smooth(150, 40, 1000, 5), kAll);
}

TEST_F(TimeWeights, ReturnsExtremeWeights) {
  for (uint32_t p = 0; p < kWeightPredictors; ++p) {
    std::vector<Component> components(4, {3, {}});
    Random random(p);
    for (uint32_t i = 0; i < 300; ++i) {
      components[0].x.push_back(i % 2 ? kWeightLimit / 2 : -kWeightLimit / 2);
      components[1].x.push_back(0);
      components[2].x.push_back(kWeightLimit / 2);
      components[3].x.push_back(random() % 4 ? 0 : static_cast<double>(random() % 4000000) - 2e6);
    }
    if (p != static_cast<uint32_t>(WeightPredictor::kCosine)) {
      expect_round_trip(100, components, 1u << p);
      continue;
    }
    const Coded coded = encode(100, components, 1u << p);
    std::vector<std::vector<int32_t>> values;
    EXPECT_TRUE(decode(100, components, coded.bytes, &values));
    EXPECT_EQ(values, coded.values);
  }
}

TEST_F(TimeWeights, PicksThePredictorThatFits) {
  std::vector<Component> line{{1, {}}}, spring{{1, {}}}, wave{{1, {}}};
  Random random(1);
  double x = 0, before = 0;
  for (int f = 0; f < 256; ++f) {
    line[0].x.push_back(25 * f);
    const double next = 1.6 * x - 0.97 * before + (random() % 2 ? 20 : -20);
    before = x;
    spring[0].x.push_back(x = next);
    wave[0].x.push_back(300 * std::cos(kPi * (f + 0.5) * 9 / 256));
  }
  EXPECT_EQ(encode(256, line).predictors[0], WeightPredictor::kLine);
  EXPECT_LT(encode(256, line).bytes.size(), 16u);
  EXPECT_EQ(encode(256, spring).predictors[0], WeightPredictor::kRegression);
  EXPECT_EQ(encode(256, wave).predictors[0], WeightPredictor::kCosine);
  EXPECT_LT(encode(256, wave).bytes.size(), 18u);
}

TEST_F(TimeWeights, RoundsToTheNearestWithoutLambda) {
  const std::vector<Component> components = smooth(100, 3, 50, 3);
  for (const uint32_t allowed : {1u, 2u}) {
    const Coded coded = encode(100, components, allowed, 0);
    for (size_t j = 0; j < components.size(); ++j)
      for (size_t i = 0; i < components[j].x.size(); ++i)
        ASSERT_NEAR(coded.values[j][i] / 16.0, components[j].x[i], 0.5 + 1e-9);
  }
}

TEST_F(TimeWeights, TruncatedOrCorruptStreamsEndInTime) {
  const std::vector<Component> components = smooth(70, 6, 60, 4);
  std::vector<std::vector<int32_t>> values;
  const auto expect_within_limits = [&] {
    for (const std::vector<int32_t>& row : values)
      for (const int32_t v : row)
        ASSERT_LE(std::abs(int64_t{v}), int64_t{kWeightLimit} << kWeightFractionBits);
  };
  for (uint32_t p = 0; p < kWeightPredictors; ++p) {
    const Bytes whole = encode(70, components, 1u << p).bytes;
    for (size_t kept = 0; kept < whole.size(); kept += 3) {
      decode(70, components, Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(kept)),
             &values);
      expect_within_limits();
    }
    Random random(p);
    for (int round = 0; round < 100; ++round) {
      Bytes bytes = whole;
      for (uint32_t i = random() % 4 + 1; i > 0; --i)
        bytes[random() % std::min<size_t>(bytes.size(), 200)] = static_cast<uint8_t>(random());
      decode(70, components, bytes, &values);
      expect_within_limits();
    }
  }
}

// A run longer than a transform is cut.
TEST_F(TimeWeights, TransformsRunsOfAnyLength) {
  for (const uint32_t frames : {CosineTransform::kMaxLength, CosineTransform::kMaxLength + 1,
                                2 * CosineTransform::kMaxLength + 452}) {
    Component wave{1, {}};
    for (uint32_t f = 0; f < frames; ++f)
      wave.x.push_back(300 * std::cos(kPi * (f + 0.5) / 32));
    const std::vector<Component> components(2, wave);
    const uint32_t cosine = 1u << static_cast<uint32_t>(WeightPredictor::kCosine);
    const Coded coded = encode(frames, components, cosine);
    std::vector<std::vector<int32_t>> values;
    EXPECT_TRUE(decode(frames, components, coded.bytes, &values));
    EXPECT_EQ(values, coded.values);
    for (uint32_t f = 0; f < frames; ++f)
      ASSERT_NEAR(values[1][f] / 16.0, wave.x[f], 2) << f;
  }
}

// Pins the bytes, the regression's binary64 arithmetic included: a change here is a change of the
// format (spec/08-entropy.md, section 6).
TEST_F(TimeWeights, WritesThePinnedBytes) {
  std::vector<Component> components;
  for (int j = 0; j < 8; ++j) {
    Component c{j % 2 ? 1u : 3u, {}};
    for (uint32_t i = 0; i < c.channels * 130; ++i) {
      const auto noise = static_cast<double>(static_cast<uint32_t>(i * i * 2654435761u) >> 28);
      const double t = i % 130 - 65.0;
      c.x.push_back(t * t * t / 512 * (j - 3) + t * 4 + noise);
    }
    components.push_back(c);
  }
  constexpr uint64_t kHashes[kWeightPredictors] = {6534775254848390507u, 2550667367308787642u,
                                                   11679190363803144286u};
  for (uint32_t p = 0; p < kWeightPredictors; ++p)
    EXPECT_EQ(hash(encode(130, components, 1u << p).bytes), kHashes[p]) << p;
}

TEST_F(TimeWeights, NothingIsPredictedOverTheEndOfARun) {
  const Vector<uint32_t> runs = {1, 40, 3, 64};
  const Vector<uint32_t> one(1, 108);
  for (uint32_t p = 0; p < kWeightPredictors; ++p) {
    std::vector<double> x(3 * 108);
    for (size_t i = 0; i < x.size(); ++i) {
      const size_t f = i % 108, run = f < 1 ? 0 : f < 41 ? 1 : f < 44 ? 2 : 3;
      x[i] = 3000.0 * (static_cast<double>(run % 2) - 0.5) + 100 * std::sin(0.1 * double(f));
    }
    size_t bytes[2];
    for (size_t k = 0; k < 2; ++k) {
      const Vector<uint32_t>& cut = k == 0 ? runs : one;
      BinaryEncoder encoder;
      TimeWeightModel model(cut), decoding(cut);
      std::vector<int32_t> values(x.size()), decoded(x.size());
      for (int j = 0; j < 6; ++j)
        model.encode(encoder, 3, x.data(), 0, values.data(), 1u << p);
      const Bytes stream = encoder.finish();
      bytes[k] = stream.size();
      BinaryDecoder decoder(stream.data(), stream.size());
      for (int j = 0; j < 6; ++j)
        ASSERT_EQ(decoding.decode(decoder, 3, decoded.data()), Status::kOk);
      EXPECT_TRUE(decoder.finish());
      EXPECT_EQ(decoded, values);
    }
    if (static_cast<WeightPredictor>(p) == WeightPredictor::kCosine) {
      EXPECT_LT(bytes[0], bytes[1]);
    }
  }
}

}  // namespace
}  // namespace anicodec
