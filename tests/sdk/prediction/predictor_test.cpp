// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/prediction/predictor.h"

#include "sdk/prediction/encoder_predictor.h"
#include "tests/random.h"
#include "tests/sdk/prediction_hash.h"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace anicodec {
namespace {

VertexOrder order_of(const PredictionClip& clip, int m, int colours) {
  VertexOrder o;
  EXPECT_EQ(make_vertex_order(clip.triangles.data(), clip.triangles.size() / 3,
                              clip.positions.data(), clip.vertex_count(), m, colours, &o),
            Status::kOk);
  return o;
}

PredictionParameters parameters_of(const PredictionCase& c) {
  PredictionParameters p;
  p.channels = c.channels;
  p.radius = c.radius;
  p.schedule = c.schedule;
  p.alike = c.alike;
  return p;
}

/// Coefficients by rank, without padding, from the encoder's predictor.
std::vector<float> encoded(const PredictionCase& c, const PredictionClip& clip,
                           const VertexOrder& order) {
  const size_t n = order.vertex_count(), samples = c.components * static_cast<size_t>(c.channels);
  std::vector<float> y(n * samples);
  EncoderPredictor predictor;
  EXPECT_EQ(predictor.init(order, clip.positions.data(), parameters_of(c), c.components),
            Status::kOk);
  for (size_t j = 0; j < c.components; ++j) {
    for (size_t r = 0; r < n; ++r)
      for (int channel = 0; channel < c.channels; ++channel) {
        const size_t s = j * static_cast<size_t>(c.channels) + static_cast<size_t>(channel);
        const float p = predictor.predict(r, channel);
        y[r * samples + s] = predictor.commit(r, channel, p, clip.q[s * n + r]);
      }
    const size_t half = predictor.block_count() / 2;
    predictor.update(half, predictor.block_count(), clip.omega[j]);
    predictor.update(0, half, clip.omega[j]);
    predictor.next_component();
  }
  return y;
}

/// wide: 32-bit integers of all components, of which the first wide_components are used.
std::vector<float> decoded(const PredictionCase& c, const PredictionClip& clip,
                           const VertexOrder& order, const std::vector<int32_t>& wide = {},
                           size_t wide_components = 0) {
  const size_t n = order.vertex_count(), samples = c.components * static_cast<size_t>(c.channels);
  std::vector<float> y(coefficient_buffer_size(n, samples), 123.0f);
  CoefficientReconstruction reconstruction;
  const size_t skip = wide_components * static_cast<size_t>(c.channels) * n;
  EXPECT_EQ(reconstruction.init(order, clip.positions.data(), parameters_of(c),
                                {c.components, wide_components, wide.data(), clip.q.data() + skip,
                                 clip.omega.data()},
                                y.data()),
            Status::kOk);
  for (size_t l = 0; l < order.level_count(); ++l)
    reconstruction.run(order.level_start[l], order.level_start[l + 1]);
  std::vector<float> packed(n * samples);
  for (size_t r = 0; r < n; ++r)
    std::copy_n(y.data() + r * coefficient_stride(samples), samples, packed.data() + r * samples);
  return packed;
}

TEST(Predictor, ReconstructsWhatTheEncoderPredictedFrom) {
  for (const PredictionCase& c : kPredictionCases) {
    const PredictionClip clip = prediction_clip(c.components, static_cast<size_t>(c.channels));
    const VertexOrder order = order_of(clip, c.neighbours, c.colours);
    EXPECT_EQ(encoded(c, clip, order), decoded(c, clip, order)) << c.neighbours;
  }
}

TEST(Predictor, ReconstructsThePinnedHashes) {
  for (const PredictionCase& c : kPredictionCases)
    EXPECT_EQ(reconstruction_hash(c), c.hash) << c.neighbours;
}

TEST(Predictor, TakesIntegersOfEitherWidth) {
  const PredictionCase& c = kPredictionCases[1];
  const PredictionClip clip = prediction_clip(c.components, static_cast<size_t>(c.channels));
  const VertexOrder order = order_of(clip, c.neighbours, c.colours);
  const std::vector<int32_t> wide(clip.q.begin(), clip.q.end());
  for (const size_t count : {1u, 7u, 20u})
    EXPECT_EQ(decoded(c, clip, order), decoded(c, clip, order, wide, count));
}

TEST(Predictor, DecodesTheRangesOfALevelInAnyOrder) {
  const PredictionCase& c = kPredictionCases[0];
  const PredictionClip clip = prediction_clip(c.components, 1);
  const VertexOrder order = order_of(clip, c.neighbours, c.colours);
  const size_t n = order.vertex_count(), stride = coefficient_stride(c.components);
  std::vector<float> y(coefficient_buffer_size(n, c.components), -1.0f);
  CoefficientReconstruction reconstruction;
  ASSERT_EQ(
      reconstruction.init(order, clip.positions.data(), parameters_of(c),
                          {c.components, 0, nullptr, clip.q.data(), clip.omega.data()}, y.data()),
      Status::kOk);
  for (size_t l = 0; l < order.level_count(); ++l) {
    size_t last = order.level_start[l + 1];
    while (last > order.level_start[l]) {  // from the back, in ragged pieces
      const size_t first =
          std::max<size_t>(order.level_start[l], last - std::min<size_t>(last, 11));
      reconstruction.run(first, last);
      last = first;
    }
  }
  const std::vector<float> expected = decoded(c, clip, order);
  for (size_t r = 0; r < n; ++r)
    for (size_t s = 0; s < c.components; ++s)
      ASSERT_EQ(y[r * stride + s], expected[r * c.components + s]);
}

TEST(Predictor, PredictsAffineFunctionsOfThePositions) {
  const PredictionClip clip = prediction_clip(1, 1);
  const VertexOrder order = order_of(clip, 16, 1);
  EncoderPredictor predictor;
  PredictionParameters parameters;
  ASSERT_EQ(predictor.init(order, clip.positions.data(), parameters, 1), Status::kOk);
  double sum = 0;
  size_t counted = 0;
  for (size_t r = 0; r < order.vertex_count(); ++r) {
    const int32_t* p = clip.positions.data() + 3 * size_t{order.order[r]};
    const double value = 1000 + 0.01 * p[0] - 0.02 * p[1] + 0.03 * p[2];
    const float predicted = predictor.predict(r, 0);
    const double difference = value - static_cast<double>(predicted);
    if (r >= order.vertex_count() / 4) {
      sum += std::abs(difference);
      ++counted;
    }
    const auto q = static_cast<int32_t>(std::lround(difference));
    predictor.commit(r, 0, predicted, q);
  }
  // The values span 200 steps, neighbours differ by several, and the coefficients are rounded to
  // one.
  EXPECT_LT(sum / static_cast<double>(counted), 0.35);
}

TEST(Predictor, LearnsWeightsThatThePriorDoesNotHave) {
  // Every vertex repeats the sign of its own pattern: interpolation fails, learning does not.
  const PredictionClip clip = prediction_clip(1, 1);
  const VertexOrder order = order_of(clip, 16, 1);
  const size_t n = order.vertex_count(), components = 24;
  const auto bits = [&](RefitSchedule schedule) {
    PredictionParameters parameters;
    parameters.schedule = schedule;
    EncoderPredictor predictor;
    EXPECT_EQ(predictor.init(order, clip.positions.data(), parameters, components), Status::kOk);
    double sum = 0;
    SmallRandom random(1);
    for (size_t j = 0; j < components; ++j) {
      double a[2];
      for (double& x : a)
        x = 60.0 * random.symmetric();
      double energy = 0;
      for (size_t r = 0; r < n; ++r) {
        const bool part = clip.positions[3 * size_t{order.order[r]}] % 2 != 0;
        const float p = predictor.predict(r, 0);
        const auto q = static_cast<int32_t>(std::lround(a[part] - static_cast<double>(p)));
        energy += static_cast<double>(q) * q;
        predictor.commit(r, 0, p, q);
      }
      sum += std::log2(1 + energy / static_cast<double>(n));
      predictor.update(0, predictor.block_count(), omega_byte(energy / static_cast<double>(n)));
      predictor.next_component();
    }
    return sum;
  };
  EXPECT_LT(bits(RefitSchedule::kMedium), 0.5 * bits(RefitSchedule::kNone));
}

TEST(Predictor, HeedsWhoMovesAlike) {
  // Two sheets through one another, each moving as one: positions do not tell them apart.
  const PredictionClip clip = prediction_clip(1, 1);
  const VertexOrder order = order_of(clip, 16, 1);
  const size_t n = order.vertex_count(), components = 12;
  const auto energy = [&](uint8_t alike) {
    PredictionParameters parameters;
    parameters.schedule = RefitSchedule::kNone;
    parameters.alike = alike;
    EncoderPredictor predictor;
    EXPECT_EQ(predictor.init(order, clip.positions.data(), parameters, components), Status::kOk);
    double sum = 0;
    SmallRandom random(1);
    for (size_t j = 0; j < components; ++j) {
      double a[2];
      for (double& x : a)
        x = 60.0 * random.symmetric();
      for (size_t r = 0; r < n; ++r) {
        const bool part = clip.positions[3 * size_t{order.order[r]}] % 2 != 0;
        const float p = predictor.predict(r, 0);
        const auto q = static_cast<int32_t>(std::lround(a[part] - static_cast<double>(p)));
        sum += j < 10 ? 0 : static_cast<double>(q) * q;
        predictor.commit(r, 0, p, q);
      }
      predictor.update(0, predictor.block_count(), omega_byte(1));
      predictor.next_component();
    }
    return sum;
  };
  EXPECT_LT(energy(32), 0.2 * energy(0));
}

TEST(Predictor, HandsOutTheWeightsThatItPredictsWith) {
  const PredictionClip clip = prediction_clip(1, 1);
  const VertexOrder order = order_of(clip, 16, 1);
  const size_t n = order.vertex_count(), components = 4;
  EncoderPredictor predictor;
  ASSERT_EQ(predictor.init(order, clip.positions.data(), PredictionParameters{}, components),
            Status::kOk);
  std::vector<float> weights(16 * n), before;
  SmallRandom random(2);
  for (size_t j = 0; j < components; ++j) {
    predictor.weights(weights.data());
    for (size_t r = 0; r < n; ++r) {
      double expected = 0;
      for (size_t a = 0; a < 16 && order.neighbours[16 * r + a] >= 0; ++a)
        expected += static_cast<double>(
            weights[16 * r + a] *
            predictor.coefficients(0)[static_cast<size_t>(order.neighbours[16 * r + a])]);
      const float p = predictor.predict(r, 0);
      ASSERT_NEAR(static_cast<double>(p), expected, 1.0 / 64);
      predictor.commit(r, 0, p, static_cast<int32_t>(4 * random.symmetric()));
    }
    // The schedule refits after each of the first components, but for the last one.
    EXPECT_EQ(predictor.refits(), j + 1 < components);
    before = weights;
    predictor.update(0, predictor.block_count(), omega_byte(1));
    predictor.next_component();
    predictor.weights(weights.data());
    EXPECT_EQ(weights != before, j + 1 < components);
  }
}

TEST(Predictor, SurvivesHostileInput) {
  const PredictionCase c{16, 2, 3, 20, 12, RefitSchedule::kMedium, 255, 0};
  PredictionClip clip = prediction_clip(c.components, 3);
  std::vector<int32_t> q(clip.q.begin(), clip.q.end());
  SmallRandom random(9);
  for (int32_t& x : q) {
    const uint32_t kind = random.bits() % 3;
    x = kind == 0   ? std::numeric_limits<int32_t>::min()
        : kind == 1 ? std::numeric_limits<int32_t>::max()
                    : 0;
  }
  for (size_t j = 0; j < c.components; ++j)
    clip.omega[j] = j % 2 ? 255 : 0;
  for (const bool flat : {false, true}) {
    if (flat)
      std::fill(clip.positions.begin(), clip.positions.end(), kMaxReferenceCoordinate);
    const VertexOrder order = order_of(clip, c.neighbours, c.colours);
    for (const float y : decoded(c, clip, order, q, c.components)) {
      ASSERT_TRUE(std::isfinite(y));
      ASSERT_LE(std::abs(y), 1048576.0f);
    }
  }
}

TEST(Predictor, SetsAndRestoresTheFloatingPointEnvironment) {
  const PredictionCase& c = kPredictionCases[0];
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
#if defined(__SSE2__)
  const unsigned before = _mm_getcsr() | 0x8040;  // flush to zero, denormals are zero
  _mm_setcsr(before);
#endif
  const uint64_t hash = reconstruction_hash(c);
#if defined(__SSE2__)
  const unsigned after = _mm_getcsr();
  _mm_setcsr(0x1f80);
  EXPECT_EQ(after & ~0x3fu, before & ~0x3fu);
#endif
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(hash, c.hash);
}

TEST(Predictor, RefusesParametersOutOfRange) {
  const PredictionClip clip = prediction_clip(1, 1);
  VertexOrder order = order_of(clip, 16, 1);
  PredictionParameters p;
  EXPECT_EQ(check_prediction(order, p), Status::kOk);
  p.radius = 0;
  EXPECT_EQ(check_prediction(order, p), Status::kArgument);
  p = {};
  p.channels = 2;
  EXPECT_EQ(check_prediction(order, p), Status::kArgument);
  p = {};
  p.schedule = static_cast<RefitSchedule>(kRefitScheduleCount);
  EXPECT_EQ(check_prediction(order, p), Status::kArgument);
  order = order_of(clip, 10, 1);
  EXPECT_EQ(check_prediction(order, {}), Status::kArgument);
}

TEST(Predictor, HasOmegaBytesInQuarterOctaves) {
  EXPECT_EQ(omega_value(128), 1.0f);
  EXPECT_EQ(omega_value(132), 2.0f);
  EXPECT_EQ(omega_value(0), 0x1p-32f);
  EXPECT_EQ(omega_value(130), 0x1.6a09e6p+0f);
  EXPECT_EQ(omega_byte(1 - 1.0 / 12 - 0.05), 128);
  EXPECT_EQ(omega_byte(1e30), 0);
  for (int b = 0; b < 255; ++b)
    EXPECT_NEAR(omega_value(static_cast<uint8_t>(b + 1)) / omega_value(static_cast<uint8_t>(b)),
                std::exp2(0.25), 1e-6);
}

}  // namespace
}  // namespace anicodec
