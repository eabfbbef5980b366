// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_SURFACE_SAMPLES_H_
#define ANICODEC_CODEC_SURFACE_SURFACE_SAMPLES_H_

#include "codec/surface/surface.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// A point of a mesh that moves with it.
struct SurfaceSample {
  uint32_t triangle = 0;
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< barycentric
};

/// The points that hausdorff() measures at: vertices (those with triangles), edge mid-points and
/// triangle centres, each once.
std::vector<SurfaceSample> surface_samples(const SurfaceTopology& topology);

/// The weight of each of them in a mean over the surface: the seven-point rule of hausdorff().
/// Sum 1, or all 0 for a surface without area.
std::vector<double> sample_shares(const SurfaceTopology& topology,
                                  const std::vector<SurfaceSample>& samples,
                                  const Positions& positions);

/// The place of a sample.
inline Eigen::Vector3d sample_point(const SurfaceTopology& topology, const SurfaceSample& sample,
                                    const Positions& positions) {
  const SurfaceTopology::Triangle& t = topology.triangles[sample.triangle];
  return sample.weights[0] * row(positions, t[0]) + sample.weights[1] * row(positions, t[1]) +
         sample.weights[2] * row(positions, t[2]);
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_SURFACE_SAMPLES_H_
