// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/close_fit.h"

#include "codec/remesh/decimate.h"
#include "codec/transfer/remesh_fit.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

TEST(CloseFit, LowersMeanAndLargestDistanceOfDecimatedMeshes) {
  const MeshSequence limb = corpus::make_clip("limb");
  const std::span<const float> first = limb.frame(0);
  const SurfaceFrame surface{limb.polygons, {first.begin(), first.end()}};
  for (uint32_t percent : {6, 12, 25}) {
    DecimationOptions options;
    options.vertices = limb.vertex_count * percent / 100;
    const SurfaceFrame coarse = decimate(surface, options).mesh;
    const RemeshFit fit = fit_remesh(coarse, surface);
    EXPECT_TRUE(fit.improved) << percent;
    EXPECT_LT(fit.after.mean(), 0.6 * fit.before.mean()) << percent;
    EXPECT_LT(fit.after.max(), 0.6 * fit.before.max()) << percent;
    EXPECT_LE(fit.turned_after, fit.turned_before) << percent;
  }
}

TEST(CloseFit, LeavesWhatCannotBeCloser) {
  const TestMesh ball = sphere(6);
  Surface surface(ball.topology, ball.positions);
  surface.build_index();
  Positions v = ball.positions;
  EXPECT_EQ(fit_closely(ball.topology, surface, &v).rounds, 0);
  EXPECT_EQ(v, ball.positions);
}

TEST(CloseFit, IsTheSameForAnyNumberOfThreads) {
  const TestMesh coarse = sphere(4), fine = sphere(9);
  Surface surface(fine.topology, fine.positions);
  surface.build_index();
  Positions many = coarse.positions, one = coarse.positions;
  fit_closely(coarse.topology, surface, &many);
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  fit_closely(coarse.topology, surface, &one);
  EXPECT_EQ(many, one);
}

}  // namespace
}  // namespace anicodec
