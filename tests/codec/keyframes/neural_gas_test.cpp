// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/neural_gas.h"

#include "tests/codec/keyframes/keyframe_testing.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Frames that dwell near a few poses, in the order of the poses.
MovingPoints poses(size_t count, size_t frames_each, double spread, uint32_t seed) {
  const MovingPoints centres = random_points(count, 40, seed);
  MovingPoints clip = random_points(count * frames_each, 40, seed + 1);
  for (size_t f = 0; f < clip.frame_count; f++) {
    for (size_t i = 0; i < 120; i++) {
      const float centre = centres.view().frame(f / frames_each)[i];
      clip.frame(f)[i] = centre + static_cast<float>(spread) * clip.frame(f)[i];
    }
  }
  return clip;
}

TEST(NeuralGas, AnnealsAndLowersTheCost) {
  const NeuralGas gas = neural_gas(gram_of(swinging_points(80, 60, 6, 1, 0.1)), 9);
  EXPECT_TRUE(std::is_sorted(gas.neighbourhoods.rbegin(), gas.neighbourhoods.rend()));
  EXPECT_DOUBLE_EQ(gas.neighbourhoods.front(), 4.5);
  EXPECT_EQ(gas.costs.size(), gas.neighbourhoods.size() + 1);
  // A wide neighbourhood pulls all prototypes together, a narrow one is k-means and never goes up.
  EXPECT_LT(gas.costs.back(), 0.3 * gas.costs[1]);
  EXPECT_LT(gas.costs.back(), gas.costs.front());
  for (size_t t = 0; t + 1 < gas.costs.size(); t++) {
    if (gas.neighbourhoods[t] < 0.02) {
      EXPECT_LE(gas.costs[t + 1], gas.costs[t] * (1 + 1e-12));
    }
  }
}

TEST(NeuralGas, MeasuresDistancesToItsPrototypes) {
  const MovingPoints clip = swinging_points(25, 30, 4, 2, 0.2);
  const NeuralGas gas = neural_gas(gram_of(clip), 5);
  for (Index i = 0; i < 5; i++) {
    EXPECT_NEAR(gas.prototypes.row(i).sum(), 1, 1e-12);
    std::vector<float> prototype(90);
    for (size_t c = 0; c < 90; c++) {
      double x = 0;
      for (size_t f = 0; f < 25; f++) {
        x += gas.prototypes(i, static_cast<Index>(f)) * double{clip.view().frame(f)[c]};
      }
      prototype[c] = static_cast<float>(x);
    }
    for (size_t f = 0; f < 25; f++) {
      EXPECT_NEAR(gas.squared_distances(i, static_cast<Index>(f)),
                  squared_distance(prototype.data(), clip.view().frame(f), 30), 1e-4);
    }
  }
}

TEST(NeuralGas, SpreadsOverTheClusters) {
  const MatrixXd gram = gram_of(poses(6, 10, 0.05, 3));
  for (uint64_t seed = 0; seed < 5; seed++) {
    NeuralGasOptions options;
    options.seed = seed;
    std::set<uint32_t> clusters;
    for (uint32_t f : prototype_frames(neural_gas(gram, 6, options), gram)) {
      clusters.insert(f / 10);
    }
    EXPECT_GE(clusters.size(), seed == 0 ? 6u : 5u) << "seed " << seed;
  }
}

TEST(NeuralGas, ReturnsAsManyDistinctFramesAsPrototypes) {
  const MatrixXd gram = gram_of(swinging_points(40, 20, 3, 4, 0.01));
  for (size_t count : {1u, 2u, 7u, 25u, 39u, 40u}) {
    const auto frames = prototype_frames(neural_gas(gram, count), gram);
    EXPECT_EQ(frames.size(), count);
    EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end()));
    EXPECT_EQ(std::set<uint32_t>(frames.begin(), frames.end()).size(), count);
  }
}

TEST(NeuralGas, TakesRepeatedFramesOnce) {
  MovingPoints clip = random_points(12, 30, 5);
  for (size_t f = 0; f < 12; f++) {
    std::copy_n(clip.frame(f % 4), 90, clip.frame(f));
  }
  const MatrixXd gram = gram_of(clip);
  std::set<uint32_t> poses;
  const auto frames = prototype_frames(neural_gas(gram, 8), gram);
  for (uint32_t f : frames) {
    poses.insert(f % 4);
  }
  EXPECT_EQ(frames.size(), 4u);
  EXPECT_EQ(poses.size(), 4u);
}

TEST(NeuralGas, AcceptsASingleFrame) {
  const MatrixXd gram = gram_of(random_points(1, 3, 1));
  EXPECT_THAT(prototype_frames(neural_gas(gram, 1), gram), testing::ElementsAre(0));
  const MatrixXd zero = MatrixXd::Zero(3, 3);
  EXPECT_EQ(prototype_frames(neural_gas(zero, 2), zero).size(), 1u);
}

TEST(NeuralGas, HasTheSameBitsForAnyNumberOfThreads) {
  const MatrixXd gram = gram_of(swinging_points(130, 30, 5, 6, 0.1));
  const auto compute = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return neural_gas(gram, 20);
  };
  const NeuralGas one = compute(1);
  const NeuralGas two = compute(2);
  EXPECT_EQ(one.prototypes, two.prototypes);
  EXPECT_EQ(one.costs, two.costs);
}

}  // namespace
}  // namespace anicodec
