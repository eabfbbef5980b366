// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/coefficient_model.h"

#include "format/coding/rans_coder.h"
#include "tests/random.h"

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Basis {
  uint32_t vertices, channels, components, stride;
  Vector<uint32_t> levels;
  std::vector<int32_t> neighbours;  // vertices x stride, of earlier levels
  std::vector<int32_t> q;           // components x channels x vertices

  size_t component_size() const { return size_t{vertices} * channels; }
};

/// Levels that double, as those of a mesh do; `draw` gives the residuals.
template <class Draw>
Basis make_basis(uint32_t vertices, uint32_t channels, uint32_t components, uint32_t stride,
                 Draw&& draw) {
  Basis b{vertices, channels, components, stride, {}, {}, {}};
  Random random(vertices + channels + stride);
  uint32_t first = 0;  // of the level
  for (uint32_t v = 0; v < vertices; ++v) {
    if (v == 0 || v == 2 * first + 1) {
      first = v;
      b.levels.push_back(v);
    }
    for (uint32_t a = 0; a < stride; ++a)
      b.neighbours.push_back(a < first ? static_cast<int32_t>(random() % first) : -1);
  }
  b.levels.push_back(vertices);
  b.q.resize(b.component_size() * components);
  for (size_t i = 0; i < b.q.size(); ++i)
    b.q[i] = draw(i);
  return b;
}

CoefficientModel model_of(const Basis& b) {
  return {b.channels, b.neighbours.data(), b.stride, b.levels};
}

Bytes encode(const Basis& b) {
  RansEncoder encoder;
  CoefficientModel model = model_of(b);
  std::vector<int32_t> q = b.q;
  for (uint32_t j = 0; j < b.components; ++j)
    model.code_component(encoder, q.data() + j * b.component_size());
  EXPECT_EQ(q, b.q);
  return encoder.finish();
}

std::vector<int32_t> decode(const Basis& b, const Bytes& bytes, bool* exact) {
  RansDecoder decoder(bytes);
  CoefficientModel model = model_of(b);
  std::vector<int32_t> q(b.q.size());
  for (uint32_t j = 0; j < b.components; ++j)
    model.code_component(decoder, q.data() + j * b.component_size());
  *exact = decoder.finish();
  return q;
}

void expect_round_trip(const Basis& b) {
  bool exact = false;
  EXPECT_EQ(decode(b, encode(b), &exact), b.q);
  EXPECT_TRUE(exact);
}

int32_t residual(Random& random) {
  const uint32_t r = random();
  return r % 8 ? 0 : static_cast<int32_t>(random() % 7) - 3;
}

TEST(CoefficientModel, ReturnsTheResiduals) {
  Random random(1);
  for (const uint32_t channels : {1u, 3u})
    for (const uint32_t stride : {8u, 16u})
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
    expect_round_trip(
        make_basis(300, channels, 4, 8, [](size_t i) { return static_cast<int32_t>(i % 130); }));
  }
}

TEST(CoefficientModel, TakesNextToNothingForZeros) {
  const Basis b = make_basis(20000, 1, 20, 8, [](size_t) { return 0; });
  EXPECT_LT(encode(b).size(), 100u);
}

TEST(CoefficientModel, LearnsSignsThatRepeat) {
  const auto bytes = [](bool repeat) {
    Random random(5);
    std::vector<int32_t> first(400);
    for (int32_t& x : first)
      x = random() % 2 ? 1 : -1;
    return encode(make_basis(400, 1, 30, 8,
                             [&](size_t i) {
                               const int32_t turn = i / 400 % 3 == 1 ? -1 : 1;
                               return repeat ? turn * first[i % 400] : random() % 2 ? 1 : -1;
                             }))
        .size();
  };
  EXPECT_LT(bytes(true) * 2, bytes(false));
}

TEST(CoefficientModel, TruncatedOrCorruptStreamsEndInTime) {
  Random random(6);
  const Basis b = make_basis(400, 3, 3, 8, [&](size_t) { return residual(random); });
  const Bytes bytes = encode(b);
  bool exact = true;
  for (size_t size = 0; size < bytes.size(); size += 11) {
    decode(b, Bytes(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size)), &exact);
    EXPECT_FALSE(exact);
  }
  for (size_t i = 0; i < bytes.size(); ++i) {
    Bytes changed = bytes;
    changed[i] = static_cast<uint8_t>(random());
    for (const int32_t q : decode(b, changed, &exact))
      ASSERT_LT(std::abs(q), kCoefficientLimit);
  }
}

TEST(CoefficientModel, WritesThePinnedBytes) {
  Random random(8);
  const Basis b = make_basis(600, 3, 6, 12, [&](size_t i) {
    return i % 50 == 0 ? static_cast<int32_t>(random() % 5000) - 2500 : residual(random);
  });
  uint32_t sum = 0;
  const Bytes bytes = encode(b);
  for (const uint8_t byte : bytes)
    sum = sum * 31 + byte;
  EXPECT_EQ(bytes.size(), 1526u);
  EXPECT_EQ(sum, 470644203u);
}

}  // namespace
}  // namespace anicodec
