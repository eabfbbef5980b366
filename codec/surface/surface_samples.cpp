// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_samples.h"

#include <algorithm>
#include <cstddef>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kVertexShare = 1.0 / 20, kMiddleShare = 2.0 / 15, kCentreShare = 9.0 / 20;

}  // namespace

std::vector<SurfaceSample> surface_samples(const SurfaceTopology& topology) {
  std::vector<SurfaceSample> samples;
  for (uint32_t i = 0; i < topology.vertex_count; ++i) {
    if (topology.star[i].empty())
      continue;
    const SurfaceTopology::Triangle& t = topology.triangles[topology.star[i][0]];
    const auto k = std::find(t.begin(), t.end(), i) - t.begin();
    samples.push_back({topology.star[i][0], Vector3d::Unit(k)});
  }
  for (uint32_t t = 0; t < topology.triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      if (topology.across[t][k] != SurfaceTopology::kNone && topology.across[t][k] < t)
        continue;
      Vector3d middle = Vector3d::Constant(0.5);
      middle[static_cast<Index>(k)] = 0;
      samples.push_back({t, middle});
    }
    samples.push_back({t, Vector3d::Constant(1.0 / 3)});
  }
  return samples;
}

std::vector<double> sample_shares(const SurfaceTopology& topology,
                                  const std::vector<SurfaceSample>& samples,
                                  const Positions& positions) {
  std::vector<double> area(topology.triangles.size()), around(topology.vertex_count, 0);
  double total = 0;
  for (size_t t = 0; t < area.size(); ++t) {
    area[t] = area_normal(positions, topology.triangles[t]).norm();
    total += area[t];
    for (uint32_t corner : topology.triangles[t])
      around[corner] += area[t];
  }
  std::vector<double> shares(samples.size(), 0);
  for (size_t s = 0; total > 0 && s < samples.size(); ++s) {
    const auto& [t, weights] = samples[s];
    Index place = 0;
    const double largest = weights.maxCoeff(&place), least = weights.minCoeff(&place);
    if (largest == 1) {
      weights.maxCoeff(&place);
      shares[s] = kVertexShare * around[topology.triangles[t][static_cast<size_t>(place)]];
    } else if (least == 0) {
      const uint32_t beyond = topology.across[t][static_cast<size_t>(place)];
      shares[s] = kMiddleShare * (area[t] + (beyond == SurfaceTopology::kNone ? 0 : area[beyond]));
    } else {
      shares[s] = kCentreShare * area[t];
    }
    shares[s] /= total;
  }
  return shares;
}

}  // namespace anicodec
