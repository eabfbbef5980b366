// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/distance_fit.h"

#include "codec/metrics/hausdorff.h"
#include "codec/surface/surface_samples.h"
#include "tests/codec/massage_meshes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

Polygons polygons_of(const SurfaceTopology& topology) {
  Polygons polygons;
  for (const SurfaceTopology::Triangle& t : topology.triangles)
    polygons.add(t);
  return polygons;
}

std::vector<float> floats_of(const Positions& v) {
  return {v.data(), v.data() + v.size()};
}

TEST(DistanceFit, LowersMeanAndMaximum) {
  const TestMesh coarse = sphere(4), fine = sphere(12);
  Surface surface(fine.topology, fine.positions);
  surface.build_index();
  const RigidShape shape(coarse.topology, coarse.positions);
  Positions v = coarse.positions;
  fit_distance(coarse.topology, shape, surface, {}, &v);
  const Polygons polygons = polygons_of(coarse.topology), target = polygons_of(fine.topology);
  const HausdorffDistance before =
      hausdorff(polygons, floats_of(coarse.positions), target, floats_of(fine.positions));
  const HausdorffDistance after =
      hausdorff(polygons, floats_of(v), target, floats_of(fine.positions));
  EXPECT_LT(after.mean(), 0.5 * before.mean());
  EXPECT_LT(after.max(), 0.6 * before.max());
}

TEST(DistanceFit, IsTheSameForAnyNumberOfThreads) {
  const TestMesh coarse = sphere(4), fine = sphere(9);
  Surface surface(fine.topology, fine.positions);
  surface.build_index();
  const RigidShape shape(coarse.topology, coarse.positions);
  Positions many = coarse.positions, one = coarse.positions;
  DistanceFitOptions options;
  options.rounds = 10;
  fit_distance(coarse.topology, shape, surface, options, &many);
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  fit_distance(coarse.topology, shape, surface, options, &one);
  EXPECT_EQ(many, one);
}

}  // namespace
}  // namespace anicodec
