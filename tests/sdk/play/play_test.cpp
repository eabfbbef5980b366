// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/play.h"

#include "sdk/play/play_job.h"
#include "tests/sdk/position_tolerance.h"

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct Shape {
  BasisKind kind = BasisKind::kEigenshapes;
  uint32_t vertices = 0, components = 0, wide = 0;
  bool pose = false, motions = false, corrections = false, regions = false;

  std::string name() const {
    return std::to_string(static_cast<int>(kind)) + ": " + std::to_string(vertices) +
           " vertices, " + std::to_string(components) + " components, " + std::to_string(wide) +
           " wide" + (pose ? ", pose" : "") + (motions ? ", motions" : "") +
           (corrections ? ", corrections" : "") + (regions ? ", regions" : "");
  }
};

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  for (BasisKind kind :
       {BasisKind::kKeyframes, BasisKind::kEigenshapes, BasisKind::kEigentrajectories}) {
    for (uint32_t vertices : {1u, 16u, 37u, 160u}) {
      for (uint32_t components : {0u, 1u, 7u, 43u}) {
        for (uint32_t wide : {0u, 3u, components}) {
          for (int options = 0; wide <= components && options < 8; ++options)
            all.push_back({kind, vertices, components, wide, (options & 1) != 0, (options & 2) != 0,
                           (options & 4) != 0});
          if (kind == BasisKind::kEigentrajectories && wide <= components)
            all.push_back({kind, vertices, components, wide, true, true, true, true});
        }
      }
    }
  }
  return all;
}

constexpr uint32_t kFrames = 6;

Segment random_segment(const Shape& shape, uint32_t seed) {
  std::mt19937 random(seed);
  auto real = [&] { return static_cast<float>(random()) / 0x1p31f - 1; };
  auto affine = [&] {
    Affine map;
    for (float& x : map.m)
      x = real();
    return map;
  };
  Segment s;
  s.kind = shape.kind;
  s.frames = kFrames;
  s.vertices = shape.vertices;
  s.components = shape.components;
  s.wide_components = shape.wide;
  size_t scalars = size_t{block_count(s.vertices)} * kBlock * s.channels();
  s.wide.resize(scalars * s.wide_components);
  for (size_t i = 0; i < s.wide.size(); ++i)
    s.wide[i] = static_cast<int32_t>(random()) >> (random() % 16);
  s.narrow.resize(scalars * (s.components - s.wide_components));
  for (size_t i = 0; i < s.narrow.size(); ++i)
    s.narrow[i] = static_cast<int16_t>(static_cast<int32_t>(random()) >> (16 + random() % 8));
  if (shape.regions) {
    s.regions = 3;
    s.vertex_region.resize(size_t{block_count(s.vertices)} * kBlock);
    for (uint32_t v = 0; v < s.vertex_region.size();
         ++v)  // pure blocks, and borders of two and three
      s.vertex_region[v] = v < 20    ? 0
                           : v < 90  ? 2
                           : v < 100 ? static_cast<uint8_t>(random() % 3)
                                     : 1;
  }
  s.weights.resize(size_t{kFrames} * s.regions * s.components * s.weight_channels());
  for (size_t i = 0; i < s.weights.size(); ++i)
    s.weights[i] = real() * 1e-4f;
  if (shape.pose) {
    s.pose.resize(size_t{block_count(s.vertices)} * 3 * kBlock);
    for (size_t i = 0; i < s.pose.size(); ++i)
      s.pose[i] = std::floor(real() * 1000);
    s.pose_maps.resize(size_t{kFrames} * s.regions);
    for (Affine& map : s.pose_maps)
      map = affine();
  } else {
    for (double& x : s.origin)
      x = real() * 100;
  }
  if (shape.motions) {
    s.motions.resize(kFrames);
    for (size_t f = 0; f < kFrames; ++f)
      s.motions[f] = affine();
  }
  if (shape.corrections) {
    s.correction_begin.push_back(0);
    for (uint32_t f = 0; f < kFrames; ++f) {
      for (uint32_t v = random() % 5; v < s.vertices; v += 1 + random() % 20)
        s.corrections.push_back({v, {real(), real(), real()}});
      s.correction_begin.push_back(static_cast<uint32_t>(s.corrections.size()));
    }
  }
  return s;
}

std::vector<const PlayKernels*> kernels() {
  const PlayKernels* all[kMaxPlayKernels];
  size_t count = all_play_kernels(all);
  return {all, all + count};
}

std::vector<float> floats(const PlayKernels& k, const FrameState& state, uint32_t first,
                          uint32_t count) {
  std::vector<float> out(size_t{3} * count);
  VertexOutput output;
  output.data = out.data();
  play_with(k, &state, 1, first, count, &output);
  return out;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Play, KeepsToTheToleranceWithEveryKernel) {
  uint32_t seed = 0;
  for (const Shape& shape : shapes()) {
    Segment s = random_segment(shape, ++seed);
    for (uint32_t f = 0; f < 2; ++f) {
      for (const PlayKernels* k : kernels())
        EXPECT_LE(tolerance_used(s, f, floats(*k, frame_state(s, f), 0, s.vertices)), 1)
            << k->name << ", " << shape.name();
    }
  }
}

TEST(Play, GivesTheBitsOfTheScalarKernelUnlessFused) {
  uint32_t seed = 0;
  for (const Shape& shape : shapes()) {
    Segment s = random_segment(shape, ++seed);
    FrameState state = frame_state(s, 1);
    std::vector<float> scalar = floats(kPlayKernelsScalar, state, 0, s.vertices);
    for (const PlayKernels* k : kernels()) {
      if (!k->fused) {
        EXPECT_TRUE(same_bits(floats(*k, state, 0, s.vertices), scalar))
            << k->name << ", " << shape.name();
      }
    }
  }
}

TEST(Play, GivesTheSameBitsWithAllFusedKernels) {
  uint32_t seed = 0;
  for (const Shape& shape : shapes()) {
    Segment s = random_segment(shape, ++seed);
    FrameState state = frame_state(s, 2);
    std::vector<float> first;
    for (const PlayKernels* k : kernels()) {
      if (!k->fused)
        continue;
      const std::vector<float> out = floats(*k, state, 0, s.vertices);
      if (first.empty())
        first = out;
      EXPECT_TRUE(same_bits(out, first)) << k->name << ", " << shape.name();
    }
  }
}

TEST(Play, GivesTheSameBitsForAnyRange) {
  uint32_t seed = 0;
  for (const Shape& shape : shapes()) {
    Segment s = random_segment(shape, ++seed);
    FrameState state = frame_state(s, 3);
    for (const PlayKernels* k : kernels()) {
      std::vector<float> whole = floats(*k, state, 0, s.vertices), pieces;
      for (uint32_t first = 0, count; first < s.vertices; first += count) {
        count = std::min(s.vertices - first, 1 + (first * 7 + seed) % 29);
        std::vector<float> piece = floats(*k, state, first, count);
        pieces.insert(pieces.end(), piece.begin(), piece.end());
      }
      EXPECT_TRUE(same_bits(whole, pieces)) << k->name << ", " << shape.name();
    }
  }
}

TEST(Play, GivesTheSameBitsForAnyNumberOfFrames) {
  uint32_t seed = 0;
  for (const Shape& shape : shapes()) {
    Segment s = random_segment(shape, ++seed), other = random_segment(shape, ++seed);
    std::vector<FrameState> states;
    for (uint32_t f : {0u, 5u, 1u, 1u, 3u, 2u, 4u})
      states.push_back(frame_state(f == 1 ? other : s, f));
    const uint32_t first = s.vertices / 3, count = s.vertices - first;
    for (const PlayKernels* k : kernels()) {
      for (uint32_t n = 0; n <= states.size(); ++n) {
        std::vector<std::vector<float>> out(n, std::vector<float>(size_t{3} * count));
        std::vector<VertexOutput> outputs(n);
        for (uint32_t f = 0; f < n; ++f)
          outputs[f].data = out[f].data();
        play_with(*k, states.data(), n, first, count, outputs.data());
        for (uint32_t f = 0; f < n; ++f)
          EXPECT_TRUE(same_bits(out[f], floats(*k, states[f], first, count)))
              << k->name << ", " << shape.name();
      }
    }
  }
}

TEST(Play, PlaysAnInterpolatedState) {
  Segment s = random_segment({BasisKind::kEigentrajectories, 40, 9, 2, true}, 1);
  FrameState a = frame_state(s, 2), b = frame_state(s, 3), middle = a;
  std::vector<float> weights(size_t{s.components} * 3);
  for (size_t i = 0; i < weights.size(); ++i)
    weights[i] = (a.weights[i] + b.weights[i]) / 2;
  middle.weights = weights.data();
  Affine map;
  for (size_t i = 0; i < 12; ++i)
    map.m[i] = (a.pose_maps[i] + b.pose_maps[i]) / 2;
  middle.pose_maps = map.m;
  std::vector<float> at(120), before(120), after(120);
  play(middle, 0, 40, at.data());
  play(a, 0, 40, before.data());
  play(b, 0, 40, after.data());
  for (size_t i = 0; i < at.size(); ++i)
    EXPECT_NEAR(at[i], (before[i] + after[i]) / 2, 0.5);
}

/// A segment that is its pose: vertex v is at (x[3 v], x[3 v + 1], x[3 v + 2]).
Segment still_segment(const std::vector<float>& x) {
  Segment s;
  s.kind = BasisKind::kEigenshapes;
  s.frames = 1;
  s.vertices = static_cast<uint32_t>(x.size() / 3);
  s.pose.resize(size_t{block_count(s.vertices)} * 3 * kBlock);
  for (size_t v = 0; v < s.vertices; ++v) {
    for (size_t c = 0; c < 3; ++c)
      s.pose[(v / kBlock * 3 + c) * kBlock + v % kBlock] = x[3 * v + c];
  }
  s.pose_maps.resize(1);
  return s;
}

double half_value(uint16_t h) {
  int exponent = h >> 10 & 31, mantissa = h & 1023;
  double x = exponent ? std::ldexp(1024 + mantissa, exponent - 25) : std::ldexp(mantissa, -24);
  return h & 0x8000 ? -x : x;
}

/// The binary16 next to x, ties to even, by looking at all its neighbours.
uint16_t nearest_half(float x) {
  double magnitude = std::fabs(static_cast<double>(x));
  uint16_t low = 0, high = 0x7c00;
  while (high - low > 1) {
    auto middle = static_cast<uint16_t>((low + high) / 2);
    (half_value(middle) <= magnitude ? low : high) = middle;
  }
  double below = magnitude - half_value(low);
  double above = (high == 0x7c00 ? 65536.0 : half_value(high)) - magnitude;
  uint16_t nearest = below < above || (below == above && low % 2 == 0) ? low : high;
  return nearest | (std::signbit(x) ? 0x8000 : 0);
}

/// Elements per vertex of all outputs, read back as 16-bit numbers.
std::vector<uint16_t> elements(const PlayKernels& k, const Segment& s, VertexFormat format,
                               const float* offset, const float* scale) {
  std::vector<uint16_t> out(s.vertices * size_t{vertex_format_size(format)} / 2);
  VertexOutput output;
  output.data = out.data();
  output.format = format;
  output.stride = vertex_format_size(format);
  std::copy_n(offset, 3, output.offset);
  std::copy_n(scale, 3, output.scale);
  FrameState state = frame_state(s, 0);
  play_with(k, &state, 1, 0, s.vertices, &output);
  return out;
}

constexpr float kNoOffset[3] = {0, 0, 0}, kNoScale[3] = {1, 1, 1};

TEST(Play, RoundsHalvesToNearestEven) {
  std::vector<float> x;
  for (uint32_t h = 0; h < 0x7c00; ++h) {  // every half, and around the middle to the next
    auto here = static_cast<float>(half_value(static_cast<uint16_t>(h)));
    auto next =
        h + 1 < 0x7c00 ? static_cast<float>(half_value(static_cast<uint16_t>(h + 1))) : 65536.0f;
    float middle = (here + next) / 2;
    for (float y : {here, middle, std::nextafter(middle, 0.0f), std::nextafter(middle, 1e9f)}) {
      x.push_back(y);
      x.push_back(-y);
    }
  }
  for (float y : {1e5f, 1e30f, 1e-9f, 1e-30f, 1e-40f})
    x.push_back(y);
  while (x.size() % 3)
    x.push_back(0);
  Segment s = still_segment(x);
  for (const PlayKernels* k : kernels()) {
    std::vector<uint16_t> three = elements(*k, s, VertexFormat::kFloat16x3, kNoOffset, kNoScale);
    std::vector<uint16_t> four = elements(*k, s, VertexFormat::kFloat16x4, kNoOffset, kNoScale);
    size_t wrong = 0;
    for (size_t i = 0; i < x.size(); ++i) {
      // A negative zero does not outlive the sum with the base.
      uint16_t expected = nearest_half(x[i] + 0.0f);
      wrong += three[i] != expected;
      wrong += four[i / 3 * 4 + i % 3] != expected;
      wrong += four[i / 3 * 4 + 3] != 0x3c00;
    }
    EXPECT_EQ(wrong, 0) << k->name;
  }
}

TEST(Play, StoresNormalisedIntegersClamped) {
  const float offset[3] = {-2, 0.5f, 10}, scale[3] = {4, 0.25f, -100};
  std::mt19937 random(5);
  std::vector<float> x;
  for (size_t i = 0; i < 3000; ++i) {
    float t = static_cast<float>(random()) / 0x1p31f * 1.2f - 1.2f;  // -1.2 .. 1.2
    x.push_back(offset[i % 3] + t * scale[i % 3]);
  }
  for (float y : {1e9f, -1e9f, 1e30f, -1e30f, 0.f, 3e38f})
    x.push_back(y);
  Segment s = still_segment(x);
  for (const PlayKernels* k : kernels()) {
    for (bool is_signed : {false, true}) {
      auto three = elements(*k, s, is_signed ? VertexFormat::kSnorm16x3 : VertexFormat::kUnorm16x3,
                            offset, scale);
      auto four = elements(*k, s, is_signed ? VertexFormat::kSnorm16x4 : VertexFormat::kUnorm16x4,
                           offset, scale);
      const double one = is_signed ? 32767 : 65535;
      for (size_t i = 0; i < x.size(); ++i) {
        double t = (static_cast<double>(x[i]) - offset[i % 3]) / scale[i % 3];
        t = std::clamp(t, is_signed ? -1.0 : 0.0, 1.0) * one;
        double stored = is_signed ? static_cast<int16_t>(three[i]) : three[i];
        EXPECT_NEAR(stored, t, 0.52) << k->name;
        EXPECT_EQ(four[i / 3 * 4 + i % 3], three[i]) << k->name;
        EXPECT_EQ(four[i / 3 * 4 + 3], one) << k->name;
      }
      EXPECT_EQ(three, elements(kPlayKernelsScalar, s,
                                is_signed ? VertexFormat::kSnorm16x3 : VertexFormat::kUnorm16x3,
                                offset, scale))
          << k->name;
    }
  }
}

TEST(Play, WritesOnlyTheBytesOfTheFormat) {
  Segment s = random_segment({BasisKind::kEigenshapes, 75, 5, 1, true, false, true}, 3);
  FrameState state = frame_state(s, 0);
  for (const PlayKernels* k : kernels()) {
    for (uint32_t id = 0; id < kVertexFormatCount; ++id) {
      auto format = static_cast<VertexFormat>(id);
      const size_t size = vertex_format_size(format);
      for (size_t stride : {size, size + 1, size_t{16}, size_t{32}, size_t{100}}) {
        if (stride < size)
          continue;
        for (uint32_t first : {0u, 3u, 16u}) {
          for (uint32_t count : {0u, 1u, 16u, 40u, 59u}) {
            VertexOutput packed, strided;
            packed.format = strided.format = format;
            std::vector<unsigned char> plain(size * count);
            packed.data = plain.data();
            packed.stride = size;
            play_with(*k, &state, 1, first, count, &packed);
            for (size_t shift : {size_t{0}, size_t{3}}) {  // any alignment will do
              std::vector<unsigned char> out(shift + stride * count + 64, 0xa5);
              strided.data = out.data() + shift;
              strided.stride = stride;
              play_with(*k, &state, 1, first, count, &strided);
              std::vector<unsigned char> expected(out.size(), 0xa5);
              for (size_t i = 0; i < count; ++i)
                std::copy_n(plain.data() + i * size, size, expected.data() + shift + i * stride);
              EXPECT_EQ(out, expected) << k->name << ", format " << id << ", stride " << stride;
            }
          }
        }
      }
    }
  }
}

TEST(Play, StoresThePositionsOfFloatsInEveryFormat) {
  Segment s = random_segment({BasisKind::kEigentrajectories, 75, 5, 1, true, true}, 3);
  FrameState state = frame_state(s, 0);
  for (const PlayKernels* k : kernels()) {
    std::vector<float> plain = floats(*k, state, 0, s.vertices), four(size_t{4} * s.vertices);
    VertexOutput output;
    output.format = VertexFormat::kFloat32x4;
    output.stride = 16;
    output.data = four.data();
    play_with(*k, &state, 1, 0, s.vertices, &output);
    auto halves = elements(*k, s, VertexFormat::kFloat16x3, kNoOffset, kNoScale);
    for (size_t i = 0; i < plain.size(); ++i) {
      EXPECT_EQ(four[i / 3 * 4 + i % 3], plain[i]) << k->name;
      EXPECT_EQ(four[i / 3 * 4 + 3], 1) << k->name;
      EXPECT_EQ(halves[i], nearest_half(plain[i])) << k->name;
    }
  }
}

}  // namespace
}  // namespace anicodec
