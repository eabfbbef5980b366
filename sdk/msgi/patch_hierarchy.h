// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MSGI_PATCH_HIERARCHY_H_
#define ANICODEC_SDK_MSGI_PATCH_HIERARCHY_H_

#include "format/memory.h"
#include "sdk/msgi/face_graph.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// A mesh cut into small patches, and the tree along which they are merged again (thesis section
/// 4.2.3), by integers alone. Each component's faces are cut in two connected halves again and
/// again: from two far faces both halves grow breadth first, always the smaller by one face. A leaf
/// of the tree is a patch: its own faces and one ring of hinge neighbours, so that patches overlap.
struct PatchHierarchy {
  struct Node {
    uint32_t left = kNoIndex, right = kNoIndex;  ///< kNoIndex: a leaf
    uint32_t parent = kNoIndex;
    uint32_t first_leaf = 0, last_leaf = 0;  ///< leaves [first, last) below; those of left first
    uint32_t first_link = 0, last_link = 0;  ///< links between left and right
  };

  /// Two patches whose own faces meet, p < q.
  struct Link {
    uint32_t p, q;
    uint32_t weight;  ///< number of hinges and joins
  };

  /// An edge of a patch, between two of its slots.
  struct PatchEdge {
    uint32_t edge;
    uint32_t slot_a, slot_b;
  };

  Vector<Node> nodes;          ///< children before parents, left before right
  Vector<uint32_t> leaf_node;  ///< of each leaf
  /// Faces of leaf l are patch_faces[face_begin[l]] .. patch_faces[face_begin[l+1]-1], its own ones
  /// up to own_end[l], the ring after them.
  Vector<uint32_t> face_begin, own_end, patch_faces;
  /// Slots of leaf l are slot_begin[l] .. slot_begin[l+1]-1: the vertices of its patch.
  Vector<uint32_t> slot_begin, slot_vertex;
  Vector<uint32_t> edge_begin;  ///< per leaf, into patch_edges
  Vector<PatchEdge> patch_edges;
  Vector<Link> links;
  /// Nodes by height: level h holds level_nodes[level_begin[h]] .. level_nodes[level_begin[h+1]-1],
  /// the leaves being level 0.
  Vector<uint32_t> level_begin, level_nodes;
  /// The lowest node below which all faces of a vertex are; kNoIndex for vertices without face.
  Vector<uint32_t> vertex_node;

  size_t leaf_count() const { return leaf_node.size(); }
};

/// Leaves have at most `leaf_faces` (at least 1) faces of their own, but for meshes whose cuts are
/// so uneven that the tree would be deeper than 48. O(faces log(faces / leaf_faces)).
PatchHierarchy make_patch_hierarchy(const FaceGraph& graph, uint32_t leaf_faces);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MSGI_PATCH_HIERARCHY_H_
