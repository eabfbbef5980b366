// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/massage.h"

#include "codec/connectivity/weld.h"
#include "codec/massage/distance_limit.h"
#include "codec/massage/massage_quality.h"
#include "codec/massage/shape_fit.h"
#include "codec/metrics/hausdorff.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

MeshSequence short_clip(const char* name, uint32_t vertices, uint32_t frames) {
  return corpus::make_scaled(name, vertices, frames);
}

TEST(Massage, BringsSlidingVerticesToRest) {
  const MeshSequence clip = short_clip("sliding", 1600, 8);
  const MassageResult result = massage(clip, {});
  const MassageQuality before = massage_quality(clip, clip, 0);
  const MassageQuality after = massage_quality(clip, result.sequence, 0);
  EXPECT_LT(after.distortion.conformal_mean - 1, (before.distortion.conformal_mean - 1) / 5);
  EXPECT_EQ(after.turned, 0U);
  const SurfaceComparison moved = compare_surfaces(clip, result.sequence);
  EXPECT_LT(moved.percent(moved.total.mean()), 0.1);
  EXPECT_GT(result.noise.components, 0);
  EXPECT_LE(result.noise.moved, result.noise.fitted + 0.2 * result.noise.sagitta);
  EXPECT_LE(result.noise.moved, result.noise.sagitta);
}

TEST(Massage, FollowsTheFrameAskedFor) {
  const MeshSequence clip = short_clip("sliding", 400, 4);
  MassageOptions options;
  options.reference = 2;
  const MassageResult result = massage(clip, options);
  EXPECT_TRUE(std::ranges::equal(clip.frame(2), result.sequence.frame(2)));
  EXPECT_FALSE(std::ranges::equal(clip.frame(0), result.sequence.frame(0)));
}

TEST(Massage, KeepsToTheTolerance) {
  const MeshSequence clip = short_clip("sliding", 800, 5);
  MassageOptions options;
  const double free = compare_surfaces(clip, massage(clip, options).sequence).total.max();
  options.tolerance = free / 3;
  const MassageResult result = massage(clip, options);
  // Positions are rounded to floats after that.
  EXPECT_LT(compare_surfaces(clip, result.sequence).total.max(), options.tolerance * 1.001);
}

TEST(Massage, TakesEveryClipOfTheCorpusWithASurface) {
  for (const std::string& name : corpus::clip_names()) {
    MeshSequence clip = corpus::make_clip(name);
    clip.frame_count = std::min(clip.frame_count, 3U);
    clip.positions.resize(size_t{3} * clip.vertex_count * clip.frame_count);
    if (!clip.times.empty())
      clip.times.resize(clip.frame_count);
    std::erase_if(clip.attributes, [](const Attribute& a) { return a.frames > 1; });
    if (clip.polygons.size() == 0) {
      EXPECT_THROW(massage(clip, {}), Error) << name;
      continue;
    }
    const MassageResult result = massage(clip, {});
    check(result.sequence);  // finite
    const SurfaceComparison moved = compare_surfaces(clip, result.sequence);
    EXPECT_LT(moved.percent(moved.total.max()), 10) << name;
  }
}

TEST(Massage, MovesCopiesOfAVertexTogether) {
  const MeshSequence clip = short_clip("soup", 1200, 3);
  const MassageResult result = massage(clip, {});
  const Weld weld = weld_trajectories(clip);
  ASSERT_LT(weld.representative.size(), clip.vertex_count);
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    const std::span<const float> after = std::as_const(result.sequence).frame(f);
    for (uint32_t v = 0; v < clip.vertex_count; ++v) {
      const size_t first = size_t{3} * weld.representative[weld.welded[v]];
      EXPECT_TRUE(std::ranges::equal(after.subspan(size_t{3} * v, 3), after.subspan(first, 3)));
    }
  }
}

TEST(Massage, IsTheSameForAnyNumberOfThreads) {
  const MeshSequence clip = short_clip("sliding", 400, 9);
  const MassageResult many = massage(clip, {});
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(massage(clip, {}).sequence.positions, many.sequence.positions);
}

TEST(Massage, RefusesOptionsOutOfRange) {
  const MeshSequence clip = short_clip("sliding", 400, 2);
  MassageOptions options;
  options.reference = 2;
  EXPECT_THROW(massage(clip, options), Error);
  options.reference = 0;
  options.strength = 1;
  EXPECT_THROW(massage(clip, options), Error);
}

}  // namespace
}  // namespace anicodec
