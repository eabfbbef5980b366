// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_samples.h"

#include "codec/metrics/hausdorff.h"
#include "codec/transfer/distance_fit.h"
#include "tests/codec/massage_meshes.h"

#include <numeric>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

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

}  // namespace
}  // namespace anicodec
