// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_SURFACE_REGIONS_H_
#define ANICODEC_CODEC_SEGMENT_SURFACE_REGIONS_H_

#include "codec/sequence/frame_view.h"
#include "format/memory.h"
#include "sdk/prediction/vertex_order.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace anicodec {

/// Cuts a surface into `count` regions that move each for itself: a number for each vertex. Seeds far
/// apart along the edges; then vertices at borders go, again and again, to the region whose affine
/// base and first few trajectories leave least of their motion, as clustered principal components do
/// (Kambhatla and Leen 1997; Sattler, Sarlette and Klein 2005). Small pieces of the mesh go as a whole.
/// A region that is small loses none, and a large one is dear, for a region's weights take the same
/// bytes whatever its size.
/// Looks at some of the frames and vertices of long clips. Cost: O(vertices x frames looked at x
/// (rank + count)) a round. Same result for any number of threads.
Vector<uint8_t> find_regions(const FrameView& clip, const MeshGraph& graph, uint32_t count);

/// A clip's positions, those of a region one after the other.
class RegionClips {
 public:
  /// `regions`: below `count`. Copies the clip. Cost: O(vertices x frames).
  RegionClips(const FrameView& clip, Vector<uint8_t> regions, uint32_t count);

  const Vector<uint8_t>& regions() const { return regions_; }

  size_t count() const { return vertices_.size(); }

  /// The vertices of a region, ascending.
  const std::vector<uint32_t>& vertices(size_t region) const { return vertices_[region]; }

  /// Their positions.
  FrameView clip(size_t region) const;

 private:
  Vector<uint8_t> regions_;
  std::vector<std::vector<uint32_t>> vertices_;
  std::vector<size_t> first_;  ///< vertex of each region
  std::vector<float> positions_;
  FrameView view_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_SURFACE_REGIONS_H_
