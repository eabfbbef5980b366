// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/sted.h"

#include "corpus/clips.h"
#include "tests/codec/metrics/square.h"
#include "tests/random.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

constexpr double kTimeStep = 0.0003;
constexpr double kTemporalWeight = 9.144e-5;

Sted sted_of(const MeshSequence& p, const MeshSequence& q) {
  StedMeter meter(p.polygons, p.vertex_count);
  for (uint32_t f = 0; f < p.frame_count; ++f)
    meter.add(p.frame(f), q.frame(f));
  return meter.finish();
}

TEST(Sted, TwoTrianglesOverThreeFramesByHand) {
  MeshSequence p = square(3), q = p;
  // The last frame is twice as long in x: sides 2 and 1, diagonal sqrt 5. Every vertex sees all
  // five edges.
  for (size_t i = 24; i < 36; i += 3)
    q.positions[i] *= 2;
  double total = 4 + std::sqrt(2.0);
  double along = -1, across = 0, diagonal = 1 - std::sqrt(2.5);
  double mean = (2 * along + 2 * across + std::sqrt(2.0) * diagonal) / total;
  double variance = (2 * std::pow(along - mean, 2) + 2 * std::pow(across - mean, 2) +
                     std::sqrt(2.0) * std::pow(diagonal - mean, 2)) /
                    total;
  // Nothing moves in the original, so all speeds are dt. In the last frame two vertices move by 1,
  // that is by 1 / sqrt 2 of the diameter.
  double speed = std::sqrt(0.5 + kTimeStep * kTimeStep);
  double temporal = 2 * (speed - kTimeStep) / kTimeStep / 8;
  Sted s = sted_of(p, q);
  EXPECT_NEAR(s.spatial, std::sqrt(variance) / 3, 1e-14);
  EXPECT_NEAR(s.temporal, temporal, 1e-9);
  EXPECT_NEAR(s.sted, std::sqrt(variance / 9 + std::pow(kTemporalWeight * temporal, 2)), 1e-12);
}

TEST(Sted, LocalSpeedIsTheMeanOfTheOriginal) {
  MeshSequence p = square(3), q = p;
  for (size_t i = 0; i < 12; i += 3) {
    for (size_t f : {1U, 2U}) {
      p.positions[12 * f + i] += 0.25F * static_cast<float>(f);
      q.positions[12 * f + i] += 0.25F;
    }
  }
  double speed = std::sqrt(0.0625 / 2 + kTimeStep * kTimeStep);
  Sted s = sted_of(p, q);
  EXPECT_EQ(s.spatial, 0);
  EXPECT_NEAR(s.temporal, (speed - kTimeStep) / speed / 2, 1e-12);
}

TEST(Sted, UniformScaleOfAPartCostsNothing) {
  MeshSequence p = corpus::make_clip("rigid"), q = p;
  size_t part = p.vertex_count / 7 * size_t{3};
  for (size_t f = 0; f < p.frame_count; ++f) {
    for (size_t i = 0; i < part; ++i)
      q.frame(f)[i] *= 2;
  }
  EXPECT_LT(sted_of(p, q).spatial, 1e-12);
}

TEST(Sted, NeighbourhoodsReachOneVertexFar) {
  // A strip of quads 0 2 4 6 8 / 1 3 5 7 9: moving vertex 8 along the strip changes the last edges
  // only.
  MeshSequence p;
  p.vertex_count = 10;
  p.frame_count = 1;
  for (uint32_t i = 0; i < 5; ++i) {
    for (int j = 0; j < 2; ++j) {
      p.positions.push_back(static_cast<float>(i));
      p.positions.push_back(static_cast<float>(j));
      p.positions.push_back(0);
    }
    if (i < 4)
      p.polygons.add(std::vector<uint32_t>{2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  MeshSequence q = p;
  q.positions[3 * 8] = 5;
  // All edges are 1 long. Among the edges that a vertex sees, only 68 (now 2 long) and 89 (sqrt 2)
  // have an error.
  auto deviation = [](double edges, std::vector<double> errors) {
    double mean = 0, variance = 0;
    for (double e : errors)
      mean += e / edges;
    for (double e : errors)
      variance += std::pow(e - mean, 2) / edges;
    variance += (edges - static_cast<double>(errors.size())) * mean * mean / edges;
    return std::sqrt(variance);
  };
  double stretch = -1, slant = 1 - std::sqrt(2.0);
  // From 9, 7 and 8: 79 89 57 67 68. From 8, 6 and 9: 68 89 46 67 79.
  double v8 = deviation(5, {stretch, slant}), v9 = v8;
  // From 6, 4, 7 and 8: 46 67 68 24 45 57 79 89. From 7, 5, 6 and 9: 57 67 79 35 45 46 68 89.
  double v6 = deviation(8, {stretch, slant}), v7 = v6;
  // From 4, 2, 5 and 6: 24 45 46 02 23 35 57 67 68. From 5, 3, 4 and 7: neither 68 nor 89.
  double v4 = deviation(9, {stretch});
  EXPECT_NEAR(sted_of(p, q).spatial, (v8 + v9 + v6 + v7 + v4) / 10, 1e-14);
}

TEST(Sted, PointsHaveNoSpatialPart) {
  MeshSequence p = corpus::make_clip("points"), q = p;
  for (size_t i = 0; i < q.positions.size(); i += 7)
    q.positions[i] += 0.125F;
  Sted s = sted_of(p, q);
  EXPECT_EQ(s.spatial, 0);
  EXPECT_GT(s.temporal, 0);
  EXPECT_DOUBLE_EQ(s.sted, kTemporalWeight * s.temporal);
}

double distance(std::span<const float> a, std::span<const float> b, size_t v, size_t w) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    sum += std::pow(double{a[3 * v + axis]} - double{b[3 * w + axis]}, 2);
  return std::sqrt(sum);
}

/// The definition, one sentence after the other.
Sted by_definition(const MeshSequence& p, const MeshSequence& q) {
  size_t n = p.vertex_count, frames = p.frame_count;
  std::set<std::pair<uint32_t, uint32_t>> edges;
  std::vector<std::set<uint32_t>> ring(n);
  for (uint32_t v = 0; v < n; ++v)
    ring[v].insert(v);
  for (size_t t = 0; t < p.polygons.size(); ++t) {
    auto polygon = p.polygons[t];
    for (size_t c = 0; c < polygon.size(); ++c) {
      uint32_t a = polygon[c], b = polygon[(c + 1) % polygon.size()];
      if (a == b)
        continue;
      edges.insert(std::minmax(a, b));
      ring[a].insert(b);
      ring[b].insert(a);
    }
  }
  double spatial = 0;
  for (size_t v = 0; v < n; ++v) {
    std::vector<std::pair<uint32_t, uint32_t>> near;
    for (auto e : edges) {
      if (ring[v].count(e.first) || ring[v].count(e.second))
        near.push_back(e);
    }
    for (size_t f = 0; f < frames; ++f) {
      double weight = 0, first = 0, second = 0;
      std::vector<double> w, d;
      for (auto [a, b] : near) {
        double length = distance(p.frame(f), p.frame(f), a, b);
        w.push_back(length);
        d.push_back(length == 0 ? 0 : (length - distance(q.frame(f), q.frame(f), a, b)) / length);
        weight += length;
        first += w.back() * d.back();
      }
      for (size_t i = 0; i < w.size(); ++i)
        second += w[i] * std::pow(d[i] - first / weight, 2);
      if (weight > 0)
        spatial += std::sqrt(second / weight) / static_cast<double>(n * frames);
    }
  }
  double longest = 0;
  for (size_t v = 0; v < n; ++v) {
    for (size_t w = 0; w < v; ++w)
      longest = std::max(longest, distance(p.frame(0), p.frame(0), v, w));
  }
  double temporal = 0;
  for (size_t v = 0; v < n; ++v) {
    auto speed = [&](const MeshSequence& s, size_t f) {
      return std::hypot(distance(s.frame(f), s.frame(f - 1), v, v) / longest, kTimeStep);
    };
    std::vector<double> local(frames), count(frames);
    for (size_t f = 1; f < frames; ++f) {
      for (size_t g = f < 5 ? 0 : f - 5; g <= std::min(frames, f + 5) - 1; ++g) {
        local[g] += speed(p, f);
        ++count[g];
      }
    }
    for (size_t f = 1; f < frames; ++f)
      temporal += std::abs(speed(q, f) - speed(p, f)) / (local[f] / count[f]);
  }
  temporal /= static_cast<double>(n * (frames - 1));
  return {std::sqrt(spatial * spatial + std::pow(kTemporalWeight * temporal, 2)), spatial,
          temporal};
}

class StedOfClips : public testing::TestWithParam<const char*> {};

TEST_P(StedOfClips, AgreesWithTheDefinition) {
  MeshSequence p = corpus::make_clip(GetParam());
  for (uint32_t frames : {2U, 5U, 6U, 11U, 24U}) {
    SCOPED_TRACE(frames);
    p.frame_count = std::min(frames, p.frame_count);
    p.positions.resize(size_t{3} * p.vertex_count * p.frame_count);
    MeshSequence q = p;
    SmallRandom random(1);
    for (float& x : q.positions)
      x += 0.01F * static_cast<float>(random.symmetric());
    Sted expected = by_definition(p, q), got = sted_of(p, q);
    EXPECT_GT(got.spatial, 0);
    EXPECT_NEAR(got.spatial, expected.spatial, 1e-12 * expected.spatial);
    EXPECT_NEAR(got.temporal, expected.temporal, 1e-12 * expected.temporal);
    EXPECT_NEAR(got.sted, expected.sted, 1e-12 * expected.sted);
    p = corpus::make_clip(GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Sted, StedOfClips,
                         testing::Values("nonmanifold", "polygons", "leftovers", "open_pair",
                                         "quad_box"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Sted, DoesNotDependOnTheNumberOfThreads) {
  MeshSequence p = corpus::make_scaled("cloth", 20000, 8), q = p;
  for (size_t i = 0; i < q.positions.size(); i += 7)
    q.positions[i] += 0.01F;
  auto with_threads = [&](size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return sted_of(p, q);
  };
  Sted one = with_threads(1), many = with_threads(4);
  EXPECT_EQ(one.spatial, many.spatial);
  EXPECT_EQ(one.temporal, many.temporal);
}

TEST(Sted, OneFrameHasNoTemporalPart) {
  MeshSequence p = square(1), q = p;
  q.positions[0] = -1;
  Sted s = sted_of(p, q);
  EXPECT_GT(s.spatial, 0);
  EXPECT_EQ(s.temporal, 0);
  EXPECT_EQ(s.sted, s.spatial);
}

}  // namespace
}  // namespace anicodec
