// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/sliding_solver.h"

#include "codec/massage/massage.h"
#include "codec/massage/shape_fit.h"
#include "codec/metrics/hausdorff.h"
#include "codec/sequence/error.h"
#include "codec/surface/mesh_quality.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

TEST(SlidingSolver, BringsAFlatSheetBack) {
  const TestMesh rest = flat_sheet(10);
  TestMesh shaken = rest;
  shake(&shaken, 0.25);
  const SlidingSolver solver(rest.topology, rest.positions);
  const Surface surface(shaken.topology, shaken.positions);
  Positions v = shaken.positions;
  SlidingOptions options;
  options.rounds = 20;
  options.tolerance = 1e-4;
  const Convergence end = solver.run(surface, options, &v);
  EXPECT_TRUE(end.converged);
  EXPECT_LT((v - rest.positions).cwiseAbs().maxCoeff(), 0.01);
}

TEST(SlidingSolver, KeepsVerticesOnTheCurvedSurface) {
  const TestMesh rest = sphere(8);
  TestMesh shaken = rest;
  for (uint32_t i = 0; i < rest.topology.vertex_count; ++i)
    shaken.positions.row(i) =
        (row(rest.positions, i) + 0.06 * Vector3d(std::sin(3.0 * i), std::cos(2.0 * i), 0))
            .normalized()
            .transpose();
  const SlidingSolver solver(rest.topology, rest.positions);
  Surface surface(shaken.topology, shaken.positions);
  surface.build_index();
  Positions v = shaken.positions;
  solver.run(surface, {}, &v);
  const double before = distortion(rest.topology, rest.positions, shaken.positions).conformal_mean;
  const double after = distortion(rest.topology, rest.positions, v).conformal_mean;
  EXPECT_GT(before, 1.02);
  EXPECT_LT(after, 1 + (before - 1) / 5);
  for (uint32_t i = 0; i < rest.topology.vertex_count; ++i)
    EXPECT_NEAR(row(v, i).norm(), 1, 0.02);
}

TEST(SlidingSolver, SlidesTheBoundaryAlongItself) {
  const TestMesh rest = flat_sheet(8);
  TestMesh shaken = rest;
  shaken.positions(3, 0) += 0.4;
  const SlidingSolver solver(rest.topology, rest.positions);
  const Surface surface(shaken.topology, shaken.positions);
  Positions v = shaken.positions;
  solver.run(surface, {}, &v);
  EXPECT_NEAR(v(3, 0), 3, 0.05);
  EXPECT_EQ(v(3, 1), 0);
  EXPECT_EQ(v(0, 0), 0);
  EXPECT_EQ(v(0, 1), 0);
}

}  // namespace
}  // namespace anicodec
