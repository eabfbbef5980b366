// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_PATCH_FILTER_H_
#define ANICODEC_CODEC_MASSAGE_PATCH_FILTER_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/surface/surface_topology.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Tells what the frames of a clip share from what is each frame's own, patch by patch: a small
/// piece of surface moves almost rigidly, so after its frames are brought into one pose few
/// principal components hold its motion, while noise that is independent from frame to frame
/// spreads over all of them.
///
/// The patches overlap; what they make of a vertex is blended by its distance from their middles,
/// in edges.
class PatchFilter {
 public:
  explicit PatchFilter(const SurfaceTopology& topology);

  /// Filters the frames `first` to `first + count` of a clip. `vertices` says which vertex of the
  /// clip each vertex of the topology is; others stay as they are, and so do vertices without
  /// triangles and pieces of fewer than eight. Noise is what a clip without motion would have in
  /// the median component, times `level`; components are shrunk by it so that the squared error is
  /// least (Gavish and Donoho, "Optimal shrinkage of singular values", IEEE Transactions on
  /// Information Theory 63, 2017). Returns how many components are left of a patch, in the mean.
  /// Patches in parallel; the same bits for any number of threads. Cost O(vertices count^2), memory
  /// that of the filtered frames.
  double run(double level, std::span<const uint32_t> vertices, uint32_t first, uint32_t count,
             MeshSequence* clip) const;

 private:
  struct Patch {
    std::vector<uint32_t> vertices;
    std::vector<float> weights;  ///< in the blend
  };

  std::vector<Patch> patches_;
};

/// The median of the eigenvalues of a sample covariance of white noise of variance 1, for `ratio`
/// dimensions a sample, in (0, 1] (Marchenko and Pastur 1967).
double marchenko_pastur_median(double ratio);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_PATCH_FILTER_H_
