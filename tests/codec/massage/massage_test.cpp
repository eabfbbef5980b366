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
#include "corpus/sliding.h"
#include "tests/codec/massage_meshes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

/// Moves inner vertices of a flat sheet in its plane.
void shake(TestMesh* mesh, double by) {
  for (uint32_t i = 0; i < mesh->topology.vertex_count; ++i) {
    if (mesh->topology.kind[i] == VertexKind::kInner)
      mesh->positions.row(i) +=
          by * Eigen::RowVector3d(std::sin(7.0 * i), std::cos(5.0 * i + 1), 0);
  }
}

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

TEST(ShapeFit, UniformWeightsEvenOutASheet) {
  const TestMesh even = flat_sheet(10);  // its inner vertices are the means of their neighbours
  TestMesh mesh = even;
  shake(&mesh, 0.3);
  const RowMatrix shape = shape_matrix(mesh.topology, mesh.positions, ShapeWeights::kUniform);
  Surface surface(mesh.topology, mesh.positions);
  surface.build_index();
  Positions v = mesh.positions;
  ShapeFit fitter(mesh.topology, shape);
  ShapeFitOptions options;
  options.lambda = 0.05;
  options.rounds = 30;
  const ShapeFitReport report = fitter.run(surface, options, &v);
  EXPECT_TRUE(report.convergence.converged);
  EXPECT_LT((v - even.positions).norm(), 0.5 * (mesh.positions - even.positions).norm());
  EXPECT_LT(v.col(2).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ShapeFit, DoesNotShrinkASphere) {
  const TestMesh ball = sphere(8);
  const RowMatrix shape = shape_matrix(ball.topology, ball.positions, ShapeWeights::kMeanValue);
  Surface surface(ball.topology, ball.positions);
  surface.build_index();
  Positions v = ball.positions;
  ShapeFit fitter(ball.topology, shape);
  ShapeFitOptions options;
  options.lambda = 0.1;
  fitter.run(surface, options, &v);
  EXPECT_LT((v - ball.positions).rowwise().norm().maxCoeff(), 2e-3);
}

TEST(ShapeFit, IterativeAndDirectSolversAgree) {
  TestMesh mesh = flat_sheet(8);
  shake(&mesh, 0.2);
  const RowMatrix shape = shape_matrix(mesh.topology, mesh.positions, ShapeWeights::kUniform);
  Surface surface(mesh.topology, mesh.positions);
  surface.build_index();
  Positions direct = mesh.positions, iterative = mesh.positions;
  ShapeFitOptions options;
  options.rounds = 2;
  options.lambda = std::nextafter(0.5, 0);
  ShapeFit(mesh.topology, shape).run(surface, options, &direct);
  options.lambda = 0.5;
  ShapeFit(mesh.topology, shape).run(surface, options, &iterative);
  EXPECT_LT((direct - iterative).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(ShapeFit, LawsonLowersTheLargestDistance) {
  // A coarse sphere fitted to a fine one.
  const TestMesh coarse = sphere(4), fine = sphere(16);
  const RowMatrix shape = shape_matrix(coarse.topology, coarse.positions, ShapeWeights::kUniform);
  Surface surface(fine.topology, fine.positions);
  surface.build_index();
  ShapeFitOptions options;
  options.lambda = 0.9;
  options.rounds = 20;
  options.tolerance = 0;
  Positions plain = coarse.positions, weighted = coarse.positions;
  const ShapeFitReport a = ShapeFit(coarse.topology, shape).run(surface, options, &plain);
  options.lawson = 0.5;
  const ShapeFitReport b = ShapeFit(coarse.topology, shape).run(surface, options, &weighted);
  EXPECT_LT(b.residuals.max, a.residuals.max);
}

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
