// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_TRANSFER_GEODESIC_LANDMARKS_H_
#define ANICODEC_CODEC_TRANSFER_GEODESIC_LANDMARKS_H_

#include "codec/surface/surface.h"
#include "codec/transfer/registration.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// Lengths of ways over a mesh: shortest paths along its edges and, through every two triangles
/// that share an edge, along the other diagonal of the flattened pair.
class GeodesicGraph {
 public:
  GeodesicGraph(const SurfaceTopology& topology, const Positions& positions);

  /// From a vertex to all; infinite where there is no way. Cost: O(vertices log vertices).
  std::vector<double> distances(uint32_t from) const;

 private:
  struct Way {
    uint32_t end;
    double length;
  };

  std::vector<size_t> first_;
  std::vector<Way> ways_;
};

/// A vertex of a mesh and the vertex of a surface that it lies at.
struct Anchor {
  uint32_t vertex = 0, on_surface = 0;
};

/// The places of a mesh's vertices on a surface that shows it in another pose, told by how far it
/// is over the surface to them from anchors, places where the two are known to agree: motion hardly
/// changes that, however far it goes. At most 40 of the anchors and 120 vertices, each as far from
/// the ones before as can be; vertices that two places suit equally are left out, and anchors and places that disagree
/// with most of the others. In each round after the first the places that were found serve as anchors. Both graphs
/// may show any pose. Empty for fewer than four anchors. Cost: about 200 times that of
/// GeodesicGraph::distances(), and a round 120 times that and 15 000 operations a vertex of the surface.
std::vector<Landmark> geodesic_landmarks(const GeodesicGraph& mesh,
                                         const std::vector<Anchor>& anchors,
                                         const GeodesicGraph& surface_graph, const Surface& surface,
                                         int rounds);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_TRANSFER_GEODESIC_LANDMARKS_H_
