// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/coefficient_coder.h"

#include "format/coding/bit_cost.h"

#include <algorithm>

namespace anicodec {
namespace {

constexpr uint32_t kFine = 20;      ///< classes, two per octave
constexpr uint32_t kCoarse = 12;    ///< classes, one per octave
constexpr uint32_t kExpected = 48;  ///< classes, four per octave
constexpr uint32_t kComponents = 8, kLevels = 20, kSelect = 8;

/// Sum of the weights 6, 5, 4, 3, 3, 2, 2, 1 of the first n neighbours.
constexpr uint32_t kWeights[9] = {0, 6, 11, 15, 18, 21, 23, 25, 26};

/// 65536 / n, for means of up to 26 weights.
struct Reciprocals {
  uint32_t value[27];

  constexpr Reciprocals() : value{} {
    for (uint32_t n = 1; n < 27; ++n)
      value[n] = 65536 / n;
  }
};

constexpr Reciprocals kReciprocals{};

uint32_t states(uint32_t channels) {
  return channels == 1 ? 1 : 4;
}

int sign(int x) {
  return (x > 0) - (x < 0);
}

/// -1, 0, 1 to 0, 1, 2.
uint32_t ternary(int x) {
  return static_cast<uint32_t>(sign(x) + 1);
}

/// Notes what either outcome of each decision would take, in bits, and adapts nothing.
class DecisionCosts {
 public:
  static constexpr bool kAdapts = false;

  struct Decision {
    float yes = 0, no = 0;
  };

  bool bit(uint32_t p, bool value) {
    decisions_[count_++] = {bits(p), bits(kProbabilityOne - p)};
    return value;
  }

  bool bit(const AdaptiveBit& model, bool value) { return bit(model.probability(), value); }

  uint32_t raw(int, uint32_t value) { return value; }

  const std::array<Decision, 5>& decisions() const { return decisions_; }

 private:
  static float bits(uint32_t p) {
    return static_cast<float>(bit_cost(p)) / static_cast<float>(kBitCostOne);
  }

  std::array<Decision, 5> decisions_;  ///< of a symbol of magnitude 2
  size_t count_ = 0;
};

/// A signed number limited to +-limit, as 0 .. 2 limit.
uint32_t centred(int x, int limit) {
  return static_cast<uint32_t>(std::clamp(x, -limit, limit) + limit);
}

}  // namespace

CoefficientVertices::CoefficientVertices(uint32_t count, uint32_t channels,
                                         const int32_t* neighbours, uint32_t stride,
                                         uint32_t slices)
    : count_(count),
      channels_(channels),
      stride_(stride),
      slices_(slices),
      neighbours_(neighbours),
      valid_(count, uint8_t{0}),
      history_(count, 0),
      past_(count, 0),
      agreement_(size_t{count} * kNear, 0),
      magnitude_((size_t{slices} + 1) * (size_t{count} + 1), 0),
      value_((size_t{slices} + 2) * (size_t{count} + 1) * channels, 0) {
  if (stride < kNear) {
    padded_.assign(size_t{count} * kNear, -1);
    for (uint32_t v = 0; v < count; ++v)
      std::copy_n(neighbours + size_t{v} * stride, stride, &padded_[size_t{v} * kNear]);
    neighbours_ = padded_.data();
    stride_ = kNear;
  }
  for (uint32_t v = 0; v < count; ++v)
    while (valid_[v] < kNear && this->neighbours(v)[valid_[v]] >= 0)
      ++valid_[v];
}

void CoefficientVertices::begin(uint32_t component) {
  std::fill_n(magnitude_.data() + magnitude_at(component), size_t{count_} + 1, uint16_t{0});
  std::fill_n(value_.data() + value_at(component), (size_t{count_} + 1) * channels_, int8_t{0});
}

void CoefficientVertices::finish(uint32_t component, uint32_t first, uint32_t last) {
  const uint16_t* magnitude = magnitude_.data() + magnitude_at(component) + 1;
  for (size_t v = first; v < last; ++v) {
    const uint32_t m = std::min<uint32_t>(4u * magnitude[v], 65535);
    history_[v] = static_cast<uint16_t>((history_[v] + m) >> 1);
    past_[v] = static_cast<uint16_t>((27u * past_[v] + 5 * m) >> 5);
  }
}

CoefficientSlice::CoefficientSlice(uint32_t channels)
    : magnitudes_(
          {kFine * kFine * states(channels), kFine * kComponents * states(channels),
           kExpected * states(channels), kCoarse * kCoarse * 8, kFine * kFine * states(channels),
           kFine * kFine * states(channels), kFine * kLevels * states(channels)},
          {kSelect * states(channels), kLevels * states(channels)}),
      signs_({81, 49, 243, 243, 41 * 4}, {kSelect, kComponents}, 1),
      shares_{13107, 19660, 19660, 6553} {}

void CoefficientSlice::begin(const CoefficientVertices& vertices, uint32_t component) {
  component_ = component;
  magnitude_at_ = vertices.magnitude_at(component);
  last_at_ = vertices.magnitude_at(component, 1);
  for (uint32_t before = 0; before < 3; ++before)
    value_at_[before] = vertices.value_at(component, before);
  ready_ = false;
  running_ = 0;
}

ResidualCosts CoefficientSlice::costs(const CoefficientVertices& vertices, uint32_t v, uint32_t c) {
  prepare(vertices, v, c);
  // |q| = 2 takes all decisions that tell magnitudes up to 3 apart, each once.
  DecisionCosts decisions;
  code_prepared(vertices, decisions, v, c, 2);
  const auto& [nonzero, negative, above_1, above_3, odd] = decisions.decisions();
  ResidualCosts costs;
  costs.magnitude[0] = nonzero.no;
  costs.magnitude[1] = nonzero.yes + above_1.no;
  costs.magnitude[2] = nonzero.yes + above_1.yes + above_3.no + odd.no;
  costs.magnitude[3] = nonzero.yes + above_1.yes + above_3.no + odd.yes;
  costs.positive = negative.no;
  costs.negative = negative.yes;
  return costs;
}

void CoefficientSlice::prepare_vertex(const CoefficientVertices& vertices, uint32_t v) {
  const int32_t* ranks = vertices.neighbours(v);
  const uint16_t* m = vertices.magnitude_.data() + magnitude_at_ + 1;  // rank -1: none
  const uint32_t m0 = m[ranks[0]], m1 = m[ranks[1]], m2 = m[ranks[2]], m3 = m[ranks[3]],
                 m4 = m[ranks[4]], m5 = m[ranks[5]], m6 = m[ranks[6]], m7 = m[ranks[7]];
  const uint32_t count = vertices.valid_[v];
  const uint32_t near2 = ((m0 + m1) * kReciprocals.value[std::min(count, 2u)]) >> 16;
  near6_ = ((m0 + m1 + m2 + m3 + m4 + m5) * kReciprocals.value[std::min(count, 6u)]) >> 16;
  const uint32_t total = 6 * m0 + 5 * m1 + 4 * m2 + 3 * (m3 + m4) + 2 * (m5 + m6) + m7;
  const uint32_t near = (total * kReciprocals.value[kWeights[count]]) >> 16;
  const uint32_t far = (m4 + m5 + m6 + m7) >> 2;
  const uint32_t history = vertices.history_[v] >> 2, past = vertices.past_[v] >> 2;

  features_ = {near * 4, vertices.history_[v], vertices.past_[v], running_ >> 4};
  uint64_t expected = 0;
  for (size_t i = 0; i < features_.size(); ++i)
    expected += uint64_t{features_[i]} * static_cast<uint32_t>(shares_[i]);
  expected_ = static_cast<uint32_t>(std::min<uint64_t>(expected >> 16, 65535));

  const uint32_t n = states(vertices.channels());
  const uint32_t level = std::min(static_cast<uint32_t>(floor_log2(v + 1)), kLevels - 1);
  const auto pair = [&](uint32_t a, uint32_t b) {
    return (magnitude_class<1>(a, kFine) * kFine + magnitude_class<1>(b, kFine)) * n;
  };
  contexts_ = {
      pair(near6_, history),
      (magnitude_class<1>(past, kFine) * kComponents + std::min(component_, kComponents - 1)) * n,
      magnitude_class<2>(expected_, kExpected) * n,
      magnitude_class<0>(past, kCoarse) * kCoarse * 8 + magnitude_class<0>(near6_ >> 3, 8),
      pair(near, far),
      pair(near2, vertices.magnitude_[last_at_ + v + 1]),
      (magnitude_class<1>(running_ >> 6, kFine) * kLevels + level) * n};
  selectors_ = {magnitude_class<0>(expected_ >> 3, kSelect) * n, level * n};
  prepared_ = true;
}

void CoefficientSlice::prepare_channel(const CoefficientVertices& vertices, uint32_t v,
                                       uint32_t c) {
  if (!prepared_)
    prepare_vertex(vertices, v);
  const uint32_t state = c == 0 ? 0 : sum_ == 0 ? 1 : sum_ <= 2 ? 2 : 3;
  const uint32_t before = c == 0 ? near6_ : (sum_ * 64 * kReciprocals.value[c]) >> 16;
  const std::array<uint32_t, kMagnitudes>& x = contexts_;
  magnitudes_.select(
      {x[0] + state, x[1] + state, x[2] + state, x[3] + magnitude_class<0>(before, kCoarse) * 8,
       x[4] + state, x[5] + state, x[6] + state},
      selectors_[0] + state, selectors_[1] + state);
}

void CoefficientSlice::prepare_sign(const CoefficientVertices& vertices, uint32_t v, uint32_t c) {
  const uint32_t channels = vertices.channels();
  const auto at = [&](const int8_t* values, size_t i, uint32_t channel) {
    return int{values[i * channels + channel]};
  };
  const int32_t* ranks = vertices.neighbours(v);
  const auto near = [&](size_t a) { return static_cast<size_t>(ranks[a] + 1); };
  const int8_t* now = vertices.value_.data() + value_at_[0];
  const int8_t* before = vertices.value_.data() + value_at_[1];
  const int8_t* earlier = vertices.value_.data() + value_at_[2];
  const int own1 = sign(at(before, v + 1, c)), own2 = sign(at(earlier, v + 1, c));
  // How the neighbours' signs went with this vertex's before, applied to their signs now.
  int agreed = 0, with1 = 0, with2 = 0, all = 0, axis1 = 0, axis2 = 0;
  for (size_t a = 0; a < kNear; ++a) {
    const int s = sign(at(now, near(a), c));
    agreed += s * vertices.agreement_[size_t{v} * kNear + a];
    if (a >= 6 || s == 0)
      continue;
    all += s;
    with1 += s * sign(at(before, near(a), c));
    with2 += s * sign(at(earlier, near(a), c));
    if (c > 0)
      axis1 += s * sign(at(now, near(a), c - 1));
    if (c > 1)
      axis2 += s * sign(at(now, near(a), c - 2));
  }
  const auto level = [](int x) {  // sign and size, within +-4
    return sign(x) * static_cast<int>(magnitude_class<0>(static_cast<uint32_t>(x < 0 ? -x : x), 5));
  };
  const auto signed_class = [](int x) {
    return sign(x) *
           static_cast<int>(magnitude_class<1>(static_cast<uint32_t>(x < 0 ? -x : x), 21));
  };
  const int first = at(now, near(0), c), second = at(now, near(1), c), third = at(now, near(2), c);
  uint32_t across;
  if (c == 0)
    across = centred(all, 4) * 3 + ternary(own1);
  else
    across = (centred(axis1 * sign(at(now, v + 1, c - 1)), 4) * 9 +
              (c > 1 ? centred(axis2 * sign(at(now, v + 1, c - 2)), 4) : 4u)) *
                 3 +
             c;
  signs_.select(
      {((ternary(first) * 3 + ternary(second)) * 3 + ternary(third)) * 3 + ternary(own1),
       centred(with1 * own1, 3) * 7 + centred(with2 * own2, 3),
       (centred(level(first), 4) * 9 + centred(level(second), 4)) * 3 + ternary(third), across,
       centred(signed_class(agreed), 20) * 4 + std::min(component_, 3u)},
      magnitude_class<0>(static_cast<uint32_t>(agreed < 0 ? -agreed : agreed) >> 2, kSelect),
      std::min(component_, kComponents - 1));
}

void CoefficientSlice::learn_nonzero(CoefficientVertices& vertices, uint32_t v, uint32_t c,
                                     int32_t q) {
  const uint32_t channels = vertices.channels();
  int8_t* now = vertices.value_.data() + value_at_[0];
  now[(size_t{v} + 1) * channels + c] = static_cast<int8_t>(std::clamp(q, -100, 100));
  const int32_t* ranks = vertices.neighbours(v);
  for (size_t a = 0; a < kNear; ++a) {
    int8_t& agreement = vertices.agreement_[size_t{v} * kNear + a];
    const int s = sign(now[static_cast<size_t>(ranks[a] + 1) * channels + c]) * sign(q);
    agreement = static_cast<int8_t>(agreement - agreement / 8 + 14 * s);
  }
  sum_ += std::min(static_cast<uint32_t>(q < 0 ? -q : q), 1023u);
}

void CoefficientSlice::finish_vertex(CoefficientVertices& vertices, uint32_t v) {
  const uint32_t m = (sum_ * 64 * kReciprocals.value[vertices.channels()]) >> 16;
  vertices.magnitude_[magnitude_at_ + v + 1] = static_cast<uint16_t>(m);
  running_ = (31 * running_ + 64 * m) >> 5;
  // Normalised least mean squares; the shares stay within [0, 4].
  const auto expected = static_cast<int32_t>(expected_);
  const int32_t error = std::min(static_cast<int32_t>(4 * m), 3 * expected + 512) - expected;
  uint64_t norm = 1600;
  for (const uint32_t f : features_)
    norm += uint64_t{f} * f;
  const int shift = 63 - __builtin_clzll(norm);
  for (size_t i = 0; i < features_.size(); ++i) {
    const int64_t step = (int64_t{error} * features_[i] * 128) >> shift;
    shares_[i] = static_cast<int32_t>(std::clamp<int64_t>(shares_[i] + step, 0, 4 << 16));
  }
}

}  // namespace anicodec
