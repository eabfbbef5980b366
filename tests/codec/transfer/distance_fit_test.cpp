// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/distance_fit.h"

#include "codec/massage/untangle.h"
#include "codec/metrics/hausdorff.h"
#include "codec/surface/mesh_quality.h"
#include "codec/surface/surface_samples.h"
#include "tests/codec/massage_meshes.h"

#include <numeric>

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

TEST(SurfaceSamples, AreVerticesMiddlesAndCentres) {
  const TestMesh ball = sphere(3);
  const auto& [topology, positions] = ball;
  const std::vector<SurfaceSample> samples = surface_samples(topology);
  EXPECT_EQ(samples.size(),
            topology.vertex_count + edges(topology).size() + topology.triangles.size());
  const std::vector<double> shares = sample_shares(topology, samples, positions);
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-12);
  EXPECT_EQ(sample_point(topology, samples[5], positions), row(positions, 5));
}

TEST(SurfaceSamples, IntegrateASquare) {
  const TestMesh sheet = flat_sheet(4);
  const std::vector<SurfaceSample> samples = surface_samples(sheet.topology);
  const std::vector<double> shares = sample_shares(sheet.topology, samples, sheet.positions);
  double mean = 0;
  for (size_t s = 0; s < samples.size(); ++s) {
    const double x = sample_point(sheet.topology, samples[s], sheet.positions)[0];
    mean += shares[s] * x * x * x;
  }
  EXPECT_NEAR(mean, 27.0 / 4, 1e-9);
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

TEST(Untangle, TurnsTrianglesOfAnyConnectivity) {
  TestMesh sheet = flat_sheet(8);
  const TestMesh other = flat_sheet(15);
  Surface surface(other.topology, other.positions / 2);
  surface.build_index();
  sheet.positions.row(27) += Eigen::RowVector3d(1.1, 0.2, 0);
  ASSERT_FALSE(turned_triangles(sheet.topology, sheet.positions, surface).empty());
  Positions v = sheet.positions;
  EXPECT_GT(untangle(sheet.topology, surface, &v), 0U);
  EXPECT_TRUE(turned_triangles(sheet.topology, v, surface).empty());
  EXPECT_LT((v - sheet.positions).rowwise().norm().maxCoeff(), 0.5);
}

TEST(MeshQuality, DoesNotMistakeTheFarSideOfAThinPart) {
  // A plate, thinner than its triangles are off it.
  const TestMesh top = flat_sheet(6);
  std::vector<uint32_t> corners;
  Positions both(2 * top.positions.rows(), 3);
  both << top.positions, top.positions;
  both.col(2).tail(top.positions.rows()).setConstant(-0.01);
  for (const SurfaceTopology::Triangle& t : top.topology.triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  const size_t count = corners.size();
  for (size_t c = 0; c < count; c += 3) {
    for (size_t k : {size_t{0}, size_t{2}, size_t{1}})
      corners.push_back(corners[c + k] + top.topology.vertex_count);
  }
  const SurfaceTopology plate(corners, 2 * top.topology.vertex_count);
  Surface surface(plate, both);
  surface.build_index();
  Positions v = top.positions;
  v.row(14)[2] = -0.05;  // its triangles lie below the plate
  EXPECT_TRUE(turned_triangles(top.topology, v, surface).empty());
}

}  // namespace
}  // namespace anicodec
