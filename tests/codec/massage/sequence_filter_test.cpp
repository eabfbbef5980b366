// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/sequence_filter.h"

#include "tests/codec/massage_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Two waves over 200 vertices and 20 frames, and small noise.
MeshSequence noisy_waves(double noise) {
  MeshSequence clip;
  clip.vertex_count = 200;
  clip.frame_count = 20;
  for (uint32_t f = 0; f < 20; ++f) {
    for (uint32_t i = 0; i < 600; ++i)
      clip.positions.push_back(
          static_cast<float>(0.1 * i + std::sin(0.3 * f) * std::cos(0.05 * i) +
                             std::cos(0.2 * f) * std::sin(0.08 * i) +
                             noise * std::sin(12.9898 * i + 78.233 * f + 0.37 * i * f)));
  }
  return clip;
}

TEST(SequenceFilter, TakesOutNoiseAndLeavesMotion) {
  const MeshSequence clean = noisy_waves(0), noisy = noisy_waves(0.02);
  const SequenceFilter filter{FrameView(noisy)};
  MeshSequence filtered = noisy;
  play_frames(filter.weights(2 * filter.variances()[4]), 0, &filtered);
  EXPECT_LT(rms_distance(filtered, clean), 0.5 * rms_distance(noisy, clean));
}

TEST(SequenceFilter, AtLevelZeroChangesNothing) {
  const MeshSequence noisy = noisy_waves(0.02);
  MeshSequence filtered = noisy;
  play_frames(SequenceFilter{FrameView(noisy)}.weights(0), 0, &filtered);
  EXPECT_LT(rms_distance(filtered, noisy), 1e-5);
}

TEST(SequenceFilter, CombinesFramesAsOneByOne) {
  MeshSequence clip = noisy_waves(0.02);
  const Eigen::MatrixXd weights = SequenceFilter{FrameView(clip)}.weights(0.1);
  const std::vector<float> one = combination(FrameView(clip), weights.row(7));
  play_frames(weights, 0, &clip);
  EXPECT_TRUE(std::equal(one.begin(), one.end(), clip.frame(7).begin()));
}

}  // namespace
}  // namespace anicodec
