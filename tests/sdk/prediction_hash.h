// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A clip made of integers and the hashes of what the prediction reconstructs from it: the same for
// every compiler, optimisation level, instruction set and number of lanes.
#ifndef ANICODEC_TESTS_SDK_PREDICTION_HASH_H_
#define ANICODEC_TESTS_SDK_PREDICTION_HASH_H_

#include "sdk/prediction/predictor.h"
#include "sdk/prediction/vertex_order.h"
#include "tests/random.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace anicodec {

struct PredictionCase {
  int neighbours, colours, channels;
  size_t components;
  uint8_t radius;
  RefitSchedule schedule;
  uint8_t alike;
  uint64_t hash;  // FNV-1a of the coefficients, by rank
};

inline constexpr PredictionCase kPredictionCases[] = {
    {16, 1, 1, 45, 12, RefitSchedule::kMedium, 0, 0x20b2ba7dcb8e42c7},
    {16, 2, 3, 20, 14, RefitSchedule::kMedium, 0, 0x67b92155669ec63e},
    {8, 1, 3, 7, 9, RefitSchedule::kSparse, 0, 0x91848e4d6f5c1d37},
    {12, 4, 1, 30, 20, RefitSchedule::kMedium, 0, 0x6e261346da042123},
    {20, 1, 1, 12, 12, RefitSchedule::kNone, 0, 0xd0051b13eab2c6f9},
    {24, 2, 3, 25, 255, RefitSchedule::kMedium, 0, 0x769c4bd171abdf03},
    {16, 1, 1, 45, 12, RefitSchedule::kMedium, 32, 0x9fdf5b1ac2529e03},
    {12, 2, 3, 14, 14, RefitSchedule::kMedium, 8, 0x32dbd443ca69680d},
    {24, 1, 3, 9, 200, RefitSchedule::kSparse, 255, 0x295275c548f4b6b2},
    {8, 4, 1, 5, 9, RefitSchedule::kNone, 4, 0xa8f1ffa416c1ad93},
    {16, 1, 1, 30, 12, RefitSchedule::kMedium, 32, 0x8c726a81f0914e85},
    {12, 2, 3, 20, 20, RefitSchedule::kNone, 4, 0x302ee0d784d6c6e5},
    {24, 1, 3, 6, 3, RefitSchedule::kMedium, 255, 0xd21abc6f81977bcd},
};

struct PredictionClip {
  std::vector<uint32_t> triangles;
  std::vector<int32_t> positions;
  std::vector<int16_t> q;
  std::vector<uint8_t> omega;

  size_t vertex_count() const { return positions.size() / 3; }
};

/// A bent sheet with a few loose vertices and a second component; integers that decay with the
/// component.
inline PredictionClip prediction_clip(size_t components, size_t channels) {
  constexpr uint32_t width = 41, height = 29;
  PredictionClip clip;
  SmallRandom numbers(12345);
  const auto random = [&](uint32_t range) { return static_cast<int32_t>(numbers.below(range)); };
  for (int32_t y = 0; y < int32_t{height}; ++y)
    for (int32_t x = 0; x < int32_t{width}; ++x) {
      const int32_t p[] = {190 * x + random(40), 210 * y + random(40),
                           (x - 20) * (x - 20) * 3 - (y - 15) * (y - 11) * 4 + random(30)};
      clip.positions.insert(clip.positions.end(), p, p + 3);
    }
  for (uint32_t y = 0; y + 1 < height; ++y)
    for (uint32_t x = 0; x + 1 < width; ++x) {
      if (y == 20)
        continue;  // two components
      const uint32_t v = y * width + x;
      const uint32_t t[] = {v, v + 1, v + width, v + 1, v + width + 1, v + width};
      clip.triangles.insert(clip.triangles.end(), t, t + 6);
    }
  for (int32_t i = 0; i < 5; ++i) {
    const int32_t p[] = {-500 * i, 900, 77};
    clip.positions.insert(clip.positions.end(), p, p + 3);
  }
  const size_t n = clip.vertex_count();
  for (size_t j = 0; j < components; ++j) {
    const auto range = static_cast<uint32_t>(2 + 400 / (1 + j * j));
    for (size_t i = 0; i < channels * n; ++i)
      clip.q.push_back(static_cast<int16_t>(random(3) ? random(range) - random(range) : 0));
    clip.omega.push_back(static_cast<uint8_t>(j < 12 ? 80 + 4 * j : 128 + j % 5));
  }
  return clip;
}

inline uint64_t reconstruction_hash(const PredictionCase& c) {
  const auto channels = static_cast<size_t>(c.channels);
  const PredictionClip clip = prediction_clip(c.components, channels);
  const size_t n = clip.vertex_count(), samples = c.components * channels;
  VertexOrder order;
  if (make_vertex_order(clip.triangles.data(), clip.triangles.size() / 3, clip.positions.data(), n,
                        c.neighbours, c.colours, &order) != Status::kOk)
    return 0;
  PredictionParameters parameters;
  parameters.channels = c.channels;
  parameters.radius = c.radius;
  parameters.schedule = c.schedule;
  parameters.alike = c.alike;
  std::vector<float> y(coefficient_buffer_size(n, samples));
  CoefficientReconstruction reconstruction;
  if (reconstruction.init(order, clip.positions.data(), parameters,
                          {c.components, 0, nullptr, clip.q.data(), clip.omega.data()},
                          y.data()) != Status::kOk)
    return 0;
  for (size_t l = 0; l < order.level_count(); ++l)
    reconstruction.run(order.level_start[l], order.level_start[l + 1]);
  uint64_t hash = 0xcbf29ce484222325;
  for (size_t r = 0; r < n; ++r)
    for (size_t s = 0; s < samples; ++s) {
      uint32_t bits;
      std::memcpy(&bits, &y[r * coefficient_stride(samples) + s], 4);
      for (int byte = 0; byte < 4; ++byte)
        hash = (hash ^ (bits >> (8 * byte) & 255)) * 0x100000001b3;
    }
  return hash;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_SDK_PREDICTION_HASH_H_
