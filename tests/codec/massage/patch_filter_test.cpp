// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/patch_filter.h"

#include "codec/massage/sliding_solver.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr uint32_t kSide = 16, kFrames = 20;

std::vector<uint32_t> all_vertices() {
  std::vector<uint32_t> vertices(kSide * kSide);
  std::iota(vertices.begin(), vertices.end(), 0U);
  return vertices;
}

TEST(PatchFilter, TakesOutNoiseAndLeavesMotion) {
  const TestMesh sheet = flat_sheet(kSide);
  const MeshSequence clean = bending_sheet(sheet, kFrames, 0),
                     noisy = bending_sheet(sheet, kFrames, 0.02);
  MeshSequence filtered = noisy;
  const double components =
      PatchFilter(sheet.topology).run(1, all_vertices(), 0, kFrames, &filtered);
  EXPECT_LT(rms_distance(filtered, clean), 0.5 * rms_distance(noisy, clean));
  EXPECT_GT(components, 0.5);
  EXPECT_LT(components, 5);
}

TEST(PatchFilter, LeavesOtherFramesAndVerticesAlone) {
  const TestMesh sheet = flat_sheet(kSide);
  const MeshSequence noisy = bending_sheet(sheet, kFrames, 0.02);
  MeshSequence filtered = noisy;
  PatchFilter(sheet.topology).run(1, all_vertices(), 5, 10, &filtered);
  for (uint32_t f : {0U, 4U, 15U, 19U})
    EXPECT_TRUE(std::ranges::equal(noisy.frame(f), filtered.frame(f))) << f;
  EXPECT_FALSE(std::ranges::equal(noisy.frame(5), filtered.frame(5)));
  const TestMesh small = flat_sheet(2);
  MeshSequence same = noisy;
  PatchFilter(small.topology).run(1, std::vector<uint32_t>{0, 1, 16, 17}, 0, kFrames, &same);
  EXPECT_EQ(same.positions, noisy.positions);
}

TEST(PatchFilter, LeavesMotionOfFewComponentsWithoutNoise) {
  const TestMesh sheet = flat_sheet(kSide);
  const MeshSequence clean = bending_sheet(sheet, kFrames, 0);
  MeshSequence filtered = clean;
  PatchFilter(sheet.topology).run(1, all_vertices(), 0, kFrames, &filtered);
  EXPECT_LT(rms_distance(filtered, clean), 1e-4);
}

TEST(PatchFilter, KnowsTheMedianOfNoise) {
  EXPECT_NEAR(marchenko_pastur_median(1e-6), 1, 1e-3);
  // The hard threshold of a square matrix, 4 / sqrt(3 median), is known to be 2.858.
  EXPECT_NEAR(4 / std::sqrt(3 * marchenko_pastur_median(1)), 2.858, 1e-3);
}

}  // namespace
}  // namespace anicodec
