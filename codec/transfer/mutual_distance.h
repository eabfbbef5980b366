// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_TRANSFER_MUTUAL_DISTANCE_H_
#define ANICODEC_CODEC_TRANSFER_MUTUAL_DISTANCE_H_

#include "codec/surface/surface.h"
#include "codec/surface/surface_samples.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace anicodec {

/// A point of a mesh and the closest point of a surface, whichever of them is the sample.
struct SamplePair {
  SurfacePoint on_mesh;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();     ///< on the surface
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, of the distance
  double distance = 0;
};

/// The surface_samples() of one side against the other.
struct SampledSide {
  std::vector<SurfaceSample> samples;
  std::vector<double> shares;    ///< see sample_shares()
  std::vector<uint32_t> starts;  ///< triangles of the other side where walks start
  std::vector<SamplePair> pairs;

  explicit SampledSide(const SurfaceTopology& topology);

  double mean() const;
  double max() const;
};

/// A mesh that moves and a surface that does not, sampled against each other, as hausdorff() does.
/// Both outlive it; the surface has an index.
class MutualDistance {
 public:
  MutualDistance(const SurfaceTopology& mesh, const Surface& surface);

  /// Measures at these positions of the mesh: exactly, by indices, or by walking from where the
  /// closest points were. On all threads; the result does not depend on their number. Cost: about
  /// six queries a vertex of either side.
  void update(const Positions& v, bool by_index);

  double mean() const { return std::max(from_mesh.mean(), from_surface.mean()); }

  double max() const { return std::max(from_mesh.max(), from_surface.max()); }

  SampledSide from_mesh, from_surface;

 private:
  void set_direction(uint32_t triangle, SamplePair* pair) const;

  const SurfaceTopology& mesh_;
  const Surface& surface_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_MUTUAL_DISTANCE_H_
