// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/coefficient_coder.h"

#include "tests/random.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Bytes = Vector<uint8_t>;

struct Basis {
  uint32_t vertices, channels, components, stride;
  std::vector<int32_t> neighbours;  // vertices x stride
  std::vector<int32_t> q;           // components x vertices x channels

  size_t component_size() const { return size_t{vertices} * channels; }
};

// Random earlier vertices as neighbours; `draw` gives the residuals.
template <class Draw>
Basis make_basis(uint32_t vertices, uint32_t channels, uint32_t components, uint32_t stride,
                 Draw&& draw) {
  Basis b{vertices, channels, components, stride, {}, {}};
  Random random(vertices + channels + stride);
  for (uint32_t v = 0; v < vertices; ++v)
    for (uint32_t a = 0; a < stride; ++a)
      b.neighbours.push_back(a < v ? static_cast<int32_t>(random() % v) : -1);
  b.q.resize(b.component_size() * components);
  for (size_t i = 0; i < b.q.size(); ++i)
    b.q[i] = draw(i);
  return b;
}

// Each component by channel, then vertex, as models want it; or back.
std::vector<int32_t> turned(const Basis& b, const std::vector<int32_t>& q, bool back = false) {
  std::vector<int32_t> out(q.size());
  for (size_t j = 0; j < b.components; ++j)
    for (size_t v = 0; v < b.vertices; ++v)
      for (size_t c = 0; c < b.channels; ++c) {
        const size_t first = j * b.component_size();
        const size_t there = first + c * b.vertices + v, here = first + v * b.channels + c;
        out[back ? here : there] = q[back ? there : here];
      }
  return out;
}

std::vector<Bytes> encode_slices(const Basis& b, uint32_t slices) {
  std::vector<BinaryEncoder> encoders(slices);
  CoefficientModel model(b.vertices, b.channels, b.neighbours.data(), b.stride, slices);
  std::vector<int32_t> q = turned(b, b.q);
  for (uint32_t j = 0; j < b.components; ++j)
    model.code_component(encoders[model.slice()], q.data() + j * b.component_size());
  EXPECT_EQ(turned(b, q, true), b.q);
  std::vector<Bytes> streams;
  for (BinaryEncoder& encoder : encoders)
    streams.push_back(encoder.finish());
  return streams;
}

Bytes encode(const Basis& b) {
  return encode_slices(b, 1)[0];
}

std::vector<int32_t> decode(const Basis& b, const Bytes& bytes, bool* exact) {
  BinaryDecoder decoder(bytes.data(), bytes.size());
  CoefficientModel model(b.vertices, b.channels, b.neighbours.data(), b.stride);
  std::vector<int32_t> q(b.q.size());
  for (uint32_t j = 0; j < b.components; ++j)
    model.code_component(decoder, q.data() + j * b.component_size());
  *exact = decoder.finish();
  return turned(b, q, true);
}

void expect_round_trip(const Basis& b) {
  const Bytes bytes = encode(b);
  bool exact = false;
  EXPECT_EQ(decode(b, bytes, &exact), b.q);
  EXPECT_TRUE(exact);
}

int32_t residual(Random& random) {
  const uint32_t r = random();
  if (r % 8)
    return 0;
  return static_cast<int32_t>(random() % 7) - 3;
}

TEST(CoefficientModel, ReturnsTheResiduals) {
  Random random(1);
  for (const uint32_t channels : {1u, 3u})
    for (const uint32_t stride : {1u, 5u, 8u, 16u})
      for (const uint32_t vertices : {0u, 1u, 2u, 10u, 500u})
        expect_round_trip(
            make_basis(vertices, channels, 5, stride, [&](size_t) { return residual(random); }));
}

TEST(CoefficientModel, ReturnsExtremeResiduals) {
  constexpr int32_t kMax = kCoefficientLimit - 1;
  for (const uint32_t channels : {1u, 3u}) {
    expect_round_trip(make_basis(300, channels, 4, 8, [](size_t) { return 0; }));
    expect_round_trip(make_basis(300, channels, 4, 8, [](size_t) { return kMax; }));
    expect_round_trip(
        make_basis(300, channels, 40, 8, [](size_t i) { return i % 2 ? kMax : -kMax; }));
    expect_round_trip(make_basis(300, channels, 4, 8, [](size_t i) {
      return static_cast<int32_t>(1u << (i % 24)) * (i % 3 ? 1 : -1);
    }));
    Random random(2);
    expect_round_trip(make_basis(300, channels, 8, 8, [&](size_t i) {
      return i / 100 % 2 ? static_cast<int32_t>(random() % (2 * kMax)) - kMax : 0;
    }));
  }
}

TEST(CoefficientModel, CostIsWhatCodingTakes) {
  Random random(3);
  const Basis b = make_basis(400, 3, 3, 8, [&](size_t) { return residual(random); });
  CoefficientModel model(b.vertices, b.channels, b.neighbours.data(), b.stride);
  BinaryEncoder encoder;
  uint64_t total = 0;
  const int32_t* q = b.q.data();
  for (uint32_t j = 0; j < b.components; ++j) {
    model.begin_component();
    for (uint32_t v = 0; v < b.vertices; ++v)
      for (uint32_t c = 0; c < b.channels; ++c, ++q) {
        EXPECT_GT(model.cost(v, c, 5), 0u);
        EXPECT_GT(model.cost(v, c, 0), 0u);
        total += model.cost(v, c, *q);
        model.code(encoder, v, c, *q);
      }
    model.end_component();
  }
  const Bytes bytes = encoder.finish();
  EXPECT_EQ(bytes, encode(b));
  EXPECT_NEAR(static_cast<double>(total) / kBitCostOne / 8, static_cast<double>(bytes.size()), 3);
}

TEST(CoefficientModel, CostsAreThoseOfEachResidual) {
  Random random(4);
  const Basis b = make_basis(300, 3, 3, 8, [&](size_t) { return residual(random); });
  CoefficientModel model(b.vertices, b.channels, b.neighbours.data(), b.stride);
  BinaryEncoder encoder;
  const int32_t* q = b.q.data();
  for (uint32_t j = 0; j < b.components; ++j) {
    model.begin_component();
    for (uint32_t v = 0; v < b.vertices; ++v)
      for (uint32_t c = 0; c < b.channels; ++c, ++q) {
        const ResidualCosts costs = model.costs(v, c);
        for (int32_t x = -3; x <= 3; ++x) {
          const float sign = x == 0 ? 0 : x > 0 ? costs.positive : costs.negative;
          ASSERT_NEAR(costs.magnitude[std::abs(x)] + sign,
                      static_cast<float>(model.cost(v, c, x)) / kBitCostOne, 1e-4F);
        }
        model.code(encoder, v, c, *q);
      }
    model.end_component();
  }
  EXPECT_EQ(encoder.finish(), encode(b));
}

TEST(CoefficientModel, ReadsSlicesInAnyOrderThatKeepsThemBehindOneAnother) {
  Random random(6);
  for (const uint32_t channels : {1u, 3u}) {
    const Basis b = make_basis(400, channels, 19, 8, [&](size_t) { return residual(random); });
    for (const uint32_t slices : {2u, 4u, 8u}) {
      const std::vector<Bytes> streams = encode_slices(b, slices);
      std::vector<BinaryDecoder> decoders;
      for (const Bytes& stream : streams)
        decoders.emplace_back(stream.data(), stream.size());
      CoefficientModel model(b.vertices, channels, b.neighbours.data(), b.stride, slices);
      std::vector<int32_t> q(b.q.size());
      std::vector<uint32_t> done(b.components + 1, 0);  // vertices of each component
      done[b.components] = b.vertices;                  // stands before the first one
      for (uint32_t left = b.components; left > 0;) {
        const uint32_t j = random() % b.components;
        const uint32_t before = done[j == 0 ? b.components : j - 1];
        if (done[j] == before || (j >= slices && done[j - slices] < b.vertices))
          continue;
        const uint32_t next = std::min(before, done[j] + 1 + random() % 90);
        model.code_ranks(decoders[j % slices], j, done[j], next,
                         q.data() + j * b.component_size());
        done[j] = next;
        left -= next == b.vertices;
      }
      EXPECT_EQ(turned(b, q, true), b.q);
      for (const BinaryDecoder& decoder : decoders)
        EXPECT_TRUE(decoder.finish());
    }
  }
}

TEST(CoefficientModel, CodesQuietBasesInNextToNothing) {
  const Basis b = make_basis(5000, 3, 10, 8, [](size_t) { return 0; });
  EXPECT_LT(encode(b).size(), 150u);
}

TEST(CoefficientModel, LearnsSignsThatRepeat) {
  // Every vertex goes with its first neighbour: signs cost next to nothing.
  Basis b = make_basis(500, 1, 30, 8, [](size_t) { return 0; });
  Random random(4);
  for (uint32_t j = 0; j < b.components; ++j)
    for (uint32_t v = 0; v < b.vertices; ++v) {
      const int32_t n = b.neighbours[size_t{v} * b.stride];
      const size_t at = j * b.component_size();
      b.q[at + v] = n < 0 ? (random() % 2 ? 1 : -1) : b.q[at + static_cast<size_t>(n)];
    }
  EXPECT_LT(encode(b).size(), 400u);
}

TEST(CoefficientModel, TruncatedOrCorruptStreamsEndInTime) {
  Random random(5);
  const Basis b = make_basis(60, 3, 4, 8, [&](size_t) { return residual(random); });
  const Bytes whole = encode(b);
  bool exact = false;
  for (size_t kept = 0; kept < whole.size(); ++kept)
    for (const int32_t q :
         decode(b, Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(kept)), &exact))
      ASSERT_LT(std::abs(q), kCoefficientLimit);
  for (int round = 0; round < 300; ++round) {
    Bytes bytes = whole;
    for (uint32_t i = random() % 4 + 1; i > 0; --i)
      bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
    for (const int32_t q : decode(b, bytes, &exact))
      ASSERT_LT(std::abs(q), kCoefficientLimit);
  }
}

// Pins the bytes: a change here is a change of the format (spec/08-entropy.md, section 7).
TEST(CoefficientModel, WritesThePinnedBytes) {
  for (const uint32_t channels : {1u, 3u}) {
    const Basis b = make_basis(200, channels, 6, 8, [](size_t i) {
      const auto x = static_cast<uint32_t>(i * i * 2654435761u) >> 20;
      return x % 8 < 6 ? 0 : static_cast<int32_t>(x % 23 * (x % 11)) - 60;
    });
    const Bytes bytes = encode(b);
    EXPECT_EQ(bytes.size(), channels == 1 ? 428u : 1291u);
    EXPECT_EQ(hash(bytes), channels == 1 ? 4288585857486946942u : 18015519046366200394u);
  }
}

}  // namespace
}  // namespace anicodec
