// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/shape_fit.h"

#include "codec/massage/massage.h"
#include "codec/metrics/hausdorff.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

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

}  // namespace
}  // namespace anicodec
