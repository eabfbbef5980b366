// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/denoise.h"

#include "codec/massage/sliding_solver.h"
#include "codec/massage/welded_surface.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr uint32_t kNoisySide = 16, kNoisyFrames = 20;

TEST(Denoise, LeavesFewFramesAlone) {
  const MeshSequence clip = corpus::make_scaled("sliding", 400, 7);
  const WeldedSurface welded(clip);
  const std::vector<uint8_t> freedom(welded.topology.vertex_count, 2);
  MeshSequence massaged = clip;
  EXPECT_EQ(denoise(clip, welded, freedom, {}, &massaged).components, 0);
  EXPECT_EQ(massaged.positions, clip.positions);
}

TEST(Denoise, KeepsTheBoundaryInPlace) {
  const TestMesh sheet = flat_sheet(kNoisySide);
  const MeshSequence noisy = bending_sheet(sheet, kNoisyFrames, 0.02);
  const WeldedSurface welded(noisy);
  MeshSequence massaged = noisy;
  const std::vector<uint8_t> freedom = sliding_freedom(welded.topology, sheet.positions);
  denoise(noisy, welded, freedom, {}, &massaged);
  for (uint32_t f = 0; f < kNoisyFrames; ++f) {
    const Positions before = welded.frame(noisy.frame(f)), after = welded.frame(massaged.frame(f));
    for (uint32_t corner : {0U, kNoisySide - 1, kNoisySide * kNoisySide - 1})
      EXPECT_EQ(row(before, corner), row(after, corner));
    EXPECT_NE(row(before, kNoisySide + 1), row(after, kNoisySide + 1));
  }
}

}  // namespace
}  // namespace anicodec
