// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Decoding order of the vertices and the neighbours each is predicted from
// (spec/09-reconstruction.md).
#ifndef ANICODEC_SDK_PREDICTION_VERTEX_ORDER_H_
#define ANICODEC_SDK_PREDICTION_VERTEX_ORDER_H_

#include "format/memory.h"
#include "format/status.h"
#include "sdk/base/parallel_for.h"
#include "sdk/prediction/mesh_graph.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Most neighbours a vertex can be predicted from.
constexpr int kMaxNeighbours = 24;

/// Most colours a level can be split into.
constexpr int kMaxColours = 8;

/// Most regions that an order keeps apart.
constexpr int kMaxOrderRegions = 8;

/// Magnitude that no reference coordinate may exceed: differences of two are exact in binary32.
constexpr int32_t kMaxReferenceCoordinate = 1 << 21;

/// A coarse-to-fine order of n vertices. The vertices of one level depend on earlier levels only,
/// so a level can be decoded in any order, in batches or in parallel.
struct VertexOrder {
  int neighbour_count = 0;       ///< m
  Vector<uint32_t> order;        ///< n: vertex of each rank
  Vector<uint32_t> level_start;  ///< levels + 1: first rank of each level, then n
  Vector<int32_t> neighbours;    ///< n x m: ranks, nearest first; -1 from where there are no more

  size_t vertex_count() const { return order.size(); }

  size_t level_count() const { return level_start.empty() ? 0 : level_start.size() - 1; }
};

/// Builds the order from the mesh and its reference positions by repeated contraction of
/// independent vertices (decimation hierarchy in the manner of Dobkin and Kirkpatrick), in integers
/// alone; degenerate and duplicate triangles do no harm.
/// positions: vertex_count x 3, at most kMaxReferenceCoordinate in magnitude.
/// neighbours: m, 1..kMaxNeighbours. colours: 1..kMaxColours parts that a level is split into; more
/// let a vertex see more of its surroundings. kArgument: m or colours out of range; kQuantizer: a
/// position is too large. Cost: O(vertices) for every input, however irregular. Neighbours are looked
/// for on the host's threads; nothing depends on them. A graph that is not needed any more is best
/// moved.
/// regions: a number below kMaxOrderRegions for each vertex, whose neighbours are then of its own
/// region; null: all are of one.
Status make_vertex_order(MeshGraph graph, const int32_t* positions, int neighbours, int colours,
                         VertexOrder* out, const uint8_t* regions = nullptr,
                         const HostThreads& threads = {});

/// The same from triangles.
Status make_vertex_order(const uint32_t* triangles, size_t triangle_count, const int32_t* positions,
                         size_t vertex_count, int neighbours, int colours, VertexOrder* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_VERTEX_ORDER_H_
