// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/distance_limit.h"

#include "codec/massage/massage.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

TEST(DistanceLimit, DrawsBackOnlyWhatIsTooFar) {
  const TestMesh sheet = flat_sheet(10);
  Surface surface(sheet.topology, sheet.positions);
  surface.build_index();
  Positions v = sheet.positions;
  v(44, 2) += 1;     // too far
  v(22, 2) += 0.05;  // not
  v(71, 0) += 0.3;   // along the surface
  EXPECT_GT(limit_distance(surface, 0.1, &v), 0U);
  EXPECT_LE(v(44, 2), 0.1);
  EXPECT_GT(v(44, 2), 0.04);
  EXPECT_EQ(v(22, 2), 0.05);
  EXPECT_NEAR(v(71, 0), 1.3, 1e-12);
}

TEST(DistanceLimit, LeavesAnUnmovedSurface) {
  const TestMesh ball = sphere(4);
  Surface surface(ball.topology, ball.positions);
  surface.build_index();
  Positions v = ball.positions;
  EXPECT_EQ(limit_distance(surface, 1e-9, &v), 0U);
}

TEST(DistanceLimit, BelowRoundingLeavesNothingMoved) {
  const TestMesh ball = sphere(4);
  Surface surface(ball.topology, ball.positions);
  surface.build_index();
  for (const double limit : {0.0, 1e-30, 1e-200}) {
    for (const double moved : {0.3, 1e10}) {
      Positions v = ball.positions;
      v(5, 1) += moved;
      limit_distance(surface, limit, &v);
      EXPECT_EQ(v, ball.positions) << limit << " " << moved;
    }
  }
}

}  // namespace
}  // namespace anicodec
