// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/predictive_basis.h"

#include "codec/error.h"
#include "format/binary_coder.h"
#include "format/coefficient_coder.h"
#include "format/time_weights.h"
#include "sdk/vertex_order.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

constexpr uint32_t kWidth = 30, kHeight = 24, kFrames = 18;

std::vector<uint32_t> sheet_triangles() {
  std::vector<uint32_t> t;
  for (uint32_t y = 0; y + 1 < kHeight; ++y)
    for (uint32_t x = 0; x + 1 < kWidth; ++x) {
      const uint32_t v = y * kWidth + x;
      t.insert(t.end(), {v, v + 1, v + kWidth, v + 1, v + kWidth + 1, v + kWidth});
    }
  return t;
}

/// A sheet that waves and turns.
std::vector<float> sheet_frames() {
  std::vector<float> out;
  for (uint32_t f = 0; f < kFrames; ++f) {
    const float t = static_cast<float>(f), a = 0.05f * t;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const float u = 0.1f * static_cast<float>(x), v = 0.1f * static_cast<float>(y);
        const float w = 0.3f * std::sin(u + 0.4f * t) * std::cos(2 * v - 0.1f * t) + 0.1f * u * v;
        out.insert(out.end(), {20 + u * std::cos(a) - v * std::sin(a),
                               u * std::sin(a) + v * std::cos(a), w - 5});
      }
  }
  return out;
}

struct Case {
  format::BasisKind kind;
  ReferencePose pose;
  Base base;
};

const Case kCases[] = {
    {format::BasisKind::kEigentrajectories, ReferencePose::kRankThree, Base::kAffine},
    {format::BasisKind::kEigenshapes, ReferencePose::kMean, Base::kPose},
    {format::BasisKind::kEigenshapes, ReferencePose::kFrame, Base::kAffine},
};

class PredictiveBasisTest : public testing::Test {
 protected:
  const std::vector<float> positions_ = sheet_frames();
  const std::vector<uint32_t> triangles_ = sheet_triangles();
  const FrameView clip_{positions_.data(), kFrames, size_t{kWidth} * kHeight};
  const LinearAnalysis analysis_{clip_};

  PredictiveBasis encode(const Case& c, const PredictiveOptions& options) const {
    return encode_predictive_basis(
        analysis_,
        analysis_.basis(c.kind, c.pose, c.base, 1000,
                        smallest_energy(c.kind, clip_.vertex_count, kFrames, options)),
        triangles_, options);
  }

  VertexOrder order_of(const PredictiveBasis& b) const {
    VertexOrder order;
    EXPECT_EQ(make_vertex_order(triangles_.data(), triangles_.size() / 3, b.pose.data(), b.vertices,
                                b.neighbours, b.colours, &order),
              Status::kOk);
    return order;
  }
};

PredictiveOptions options_at(double step) {
  PredictiveOptions options;
  options.step = step;
  return options;
}

TEST_F(PredictiveBasisTest, KnowsTheErrorOfWhatADecoderSees) {
  for (const Case& c : kCases)
    for (const double step : {0.05, 0.005}) {
      const PredictiveBasis b = encode(c, options_at(step));
      ASSERT_GT(b.components, 0u);
      const VertexOrder order = order_of(b);
      double error = 0;
      for (size_t f = 0; f < kFrames; ++f) {
        const Eigen::MatrixXd x = decoded_frame(b, order.order, f);
        for (Eigen::Index v = 0; v < x.rows(); ++v)
          for (Eigen::Index d = 0; d < 3; ++d) {
            const double e = x(v, d) - double{clip_.frame(f)[3 * v + d]};
            error += e * e;
          }
      }
      EXPECT_NEAR(b.squared_error, error, 1e-5 * error);
      // About step^2 / 12 per coefficient, spread over the frames, and the truncated components.
      EXPECT_LT(std::sqrt(error / (3.0 * kFrames * b.vertices)), step);
    }
}

TEST_F(PredictiveBasisTest, WritesStreamsThatADecoderReads) {
  for (const Case& c : kCases) {
    PredictiveOptions options = options_at(0.01);
    options.layer_starts = {1, 3};
    const PredictiveBasis b = encode(c, options);
    ASSERT_EQ(b.coefficient_streams.size(), 3u);
    const VertexOrder order = order_of(b);
    CoefficientModel model(b.vertices, b.channels(), order.neighbours.data(), 16);
    const size_t size = size_t{b.vertices} * b.channels();
    std::vector<int32_t> q(b.components * size);
    uint32_t j = 0;
    for (size_t layer = 0; layer < 3; ++layer) {
      const std::vector<uint8_t>& bytes = b.coefficient_streams[layer];
      BinaryDecoder decoder(bytes.data(), bytes.size());
      const uint32_t last = layer < 2 ? options.layer_starts[layer] : b.components;
      for (; j < last; ++j)
        model.code_component(decoder, q.data() + j * size);
      EXPECT_TRUE(decoder.finish());
    }
    EXPECT_EQ(q, b.residuals);

    BinaryDecoder decoder(b.weight_stream.data(), b.weight_stream.size());
    TimeWeightModel weights(kFrames);
    std::vector<int32_t> base(b.base_weights.size()), values(b.weights.size());
    for (size_t i = 0; i < base.size(); i += 3 * kFrames)
      ASSERT_EQ(weights.decode(decoder, 3, base.data() + i), Status::kOk);
    const size_t rows = size_t{b.weight_channels()} * kFrames;
    for (size_t i = 0; i < values.size(); i += rows)
      ASSERT_EQ(weights.decode(decoder, b.weight_channels(), values.data() + i), Status::kOk);
    EXPECT_TRUE(decoder.finish());
    EXPECT_EQ(base, b.base_weights);
    EXPECT_EQ(values, b.weights);
  }
}

TEST_F(PredictiveBasisTest, IsReconstructedBitForBit) {
  for (const Case& c : kCases) {
    const PredictiveBasis b = encode(c, options_at(0.01));
    const VertexOrder order = order_of(b);
    const size_t n = b.vertices, channels = b.channels(), samples = b.components * channels;
    std::vector<int32_t> q(b.residuals.size());  // sample by sample
    for (size_t j = 0; j < b.components; ++j)
      for (size_t r = 0; r < n; ++r)
        for (size_t d = 0; d < channels; ++d)
          q[(j * channels + d) * n + r] = b.residuals[(j * n + r) * channels + d];
    std::vector<float> y(coefficient_buffer_size(n, samples));
    Reconstruction reconstruction;
    ASSERT_EQ(reconstruction.init(order, b.pose.data(), b.prediction,
                                  {b.components, b.components, q.data(), nullptr, b.omega.data()},
                                  y.data()),
              Status::kOk);
    reconstruction.run_all();
    for (size_t j = 0; j < b.components; ++j)
      for (size_t r = 0; r < n; ++r)
        for (size_t d = 0; d < channels; ++d)
          ASSERT_EQ(y[r * coefficient_stride(samples) + j * channels + d],
                    b.coefficients[(j * n + r) * channels + d]);
  }
}

TEST_F(PredictiveBasisTest, IsTheSameForAnyNumberOfThreads) {
  const PredictiveBasis many = encode(kCases[0], options_at(0.01));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const PredictiveBasis single = encode(kCases[0], options_at(0.01));
  EXPECT_EQ(many.coefficient_streams, single.coefficient_streams);
  EXPECT_EQ(many.weight_stream, single.weight_stream);
  EXPECT_EQ(many.pose, single.pose);
  EXPECT_EQ(many.squared_error, single.squared_error);
}

TEST_F(PredictiveBasisTest, SpendsFewerBytesForLessAccuracy) {
  size_t before = SIZE_MAX;
  double error = 0;
  for (const double step : {0.001, 0.01, 0.1}) {
    const PredictiveBasis b = encode(kCases[0], options_at(step));
    const size_t bytes = b.coefficient_bytes() + b.weight_stream.size();
    EXPECT_LT(bytes, before);
    EXPECT_GT(b.squared_error, error);
    before = bytes;
    error = b.squared_error;
  }
}

TEST_F(PredictiveBasisTest, KeepsNoComponentAtACoarseStep) {
  const PredictiveBasis b = encode(kCases[1], options_at(100));
  EXPECT_EQ(b.components, 0u);
  EXPECT_TRUE(b.coefficients.empty());
}

TEST_F(PredictiveBasisTest, RefusesImpossibleSteps) {
  EXPECT_THROW(encode(kCases[0], options_at(0)), Error);
  EXPECT_THROW(encode(kCases[0], options_at(-1)), Error);
  EXPECT_THROW(encode(kCases[0], options_at(1e-9)), Error);
}

}  // namespace
}  // namespace anicodec
