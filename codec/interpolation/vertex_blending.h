// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_INTERPOLATION_VERTEX_BLENDING_H_
#define ANICODEC_CODEC_INTERPOLATION_VERTEX_BLENDING_H_

#include "codec/surface/edge_network.h"
#include "sdk/msgi/face_graph.h"
#include "sdk/msgi/patch_hierarchy.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Multi-scale geometry interpolation as thesis section 4.2 reads with vertex blending, to compare
/// with: edge lengths and dihedral angles are interpolated, every patch is unfolded from them, and
/// up the hierarchy the halves are aligned rigidly by the vertices they share, whose two positions
/// are averaged. No linear system; seams show where patches fit badly.
class VertexBlending {
 public:
  VertexBlending(const EdgeNetwork& network, std::span<const Points> inputs, uint32_t leaf_faces);

  /// The mesh at the weights, one per input, each component turned onto the linear blend.
  Points evaluate(std::span<const double> weights) const;

 private:
  /// One vertex of a patch unfolded over an edge of a triangle that lies already.
  struct Unfolding {
    uint32_t slot, a, b, c;  ///< the new one; edge and third corner of the triangle, as slots
    uint32_t edge_ab, edge_a, edge_b;  ///< lengths: of the edge, from a and b to the new vertex
    uint32_t hinge;                    ///< kNoIndex: flat
  };

  /// The first triangle of a patch, or an edge if it has no other.
  struct Start {
    uint32_t slots[3];
    uint32_t edges[3];  ///< 01, 12, 20; kNoIndex: no length
    uint32_t first_unfolding;
  };

  struct Shared {
    uint32_t left, right;  ///< slots of one vertex
    double left_share;
  };

  /// The merge at a node of the tree.
  struct Merge {
    uint32_t first_shared = 0, first_moved = 0;
  };

  void plan_patches();
  void plan_merges();
  Points unfold(const EdgeShape& shape) const;

  const EdgeNetwork network_;
  FaceGraph graph_;
  PatchHierarchy hierarchy_;
  std::vector<Points> inputs_;
  std::vector<EdgeShape> shapes_;
  std::vector<Start> starts_;
  std::vector<Unfolding> unfoldings_;
  std::vector<Shared> shared_;
  std::vector<uint32_t> moved_;  ///< slots of right halves that others still share
  std::vector<Merge> merges_;    ///< per node and one more
  std::vector<uint32_t> final_slot_, final_node_;  ///< per vertex: where it is complete
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_INTERPOLATION_VERTEX_BLENDING_H_
