// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The order of the source's vertices as a walk over the mesh, written once for encoder and decoder
// (spec/07-topology.md, section 5).
#ifndef ANICODEC_SDK_MESH_VERTEX_WALK_H_
#define ANICODEC_SDK_MESH_VERTEX_WALK_H_

#include "format/coding/mixing.h"
#include "sdk/mesh/map_coding.h"
#include "sdk/mesh/topology.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace anicodec {

/// Programs number vertices one beside the other, row by row, or polygon by polygon. So the vertex
/// that comes next is most often a neighbour or a copy of one of the latest, which are offered
/// first, in the order of how likely they look; only others are named by their number.
class VertexWalk {
 public:
  /// @param topology  vertices and polygons in canonical order
  explicit VertexWalk(const Topology& topology);

  /// Codes source[i], the place of vertex i in the source's order. False when what was read is no
  /// permutation or the stream ran out. O(vertices) whatever the mesh.
  template <class Coder>
  bool code(Coder& coder, Vector<uint32_t>* source) {
    const auto count = static_cast<uint32_t>(vertex_coded_.size());
    DistinctNumbers numbers(count);
    Vector<uint32_t> wanted;
    if constexpr (Coder::kDecodes) {
      source->assign(count, 0);
    } else {
      wanted.resize(count);
      for (uint32_t v = 0; v < count; ++v)
        wanted[(*source)[v]] = v;
    }
    for (uint32_t s = 0; s < count; ++s) {
      const uint32_t truth = Coder::kDecodes ? 0 : wanted[s];
      start_candidates();
      uint32_t vertex = kNotYet, rank = 0;
      for (auto find : {&VertexWalk::find_beside, &VertexWalk::find_others}) {
        if (vertex == kNotYet)
          (this->*find)();
        for (; rank < candidate_count_ && vertex == kNotYet; ++rank) {
          const Candidate& c = candidates_[rank];
          select(c, rank);
          if (!model_.code(coder, 0, c.vertex == truth))
            continue;
          vertex = c.vertex;
          remember(way_of(c));
          numbers.take(vertex);
        }
      }
      if (vertex == kNotYet) {
        if (!numbers.code(coder, truth, &vertex))
          return false;
        remember(kJump);
      }
      append(vertex);
      if constexpr (Coder::kDecodes) {
        (*source)[vertex] = s;
        if (!coder.ok())
          return false;
      }
    }
    return true;
  }

 private:
  static constexpr uint32_t kNotYet = UINT32_MAX;
  static constexpr uint32_t kMaxCandidates = 32;
  static constexpr uint32_t kWindow = 48;         ///< latest vertices that are looked around
  static constexpr uint32_t kMaxNeighbours = 24;  ///< of a vertex that are looked at
  static constexpr uint32_t kMaxCopies = 8;       ///< likewise, on either side

  static constexpr uint32_t kMaxFaces = 24;  ///< likewise

  /// How a vertex was found.
  enum Way : uint8_t { kBeside, kCopy, kParallel, kNear, kJump, kWayCount };

  struct Candidate {
    uint32_t vertex;
    uint32_t distance;  ///< how many vertices ago the latest it touches was
    uint8_t nearness;   ///< class of the distance
    uint8_t copy;       ///< 1: that one is a copy of it
    uint8_t parallel;   ///< 2: it goes along what the vertex before goes along, 1: against, 0
    uint8_t count;      ///< neighbours that have their place, up to three
    uint8_t free;       ///< neighbours that have none, up to seven
    uint8_t beside;  ///< bits: the vertex before is a neighbour (4), the one before that, the third
    uint8_t filled;  ///< vertices that have their place in the fullest of its polygons, up to 4
    uint8_t completes;  ///< 1: it is the last one of a polygon
    uint8_t together;   ///< 1: it is in a polygon with the two before
  };

  /// A polygon while its vertices get their places.
  struct Face {
    uint32_t placed = 0;  ///< corners that have one
    uint32_t latest = kNotYet, second = kNotYet;
  };

  /// Bounds of some vertices or neighbours.
  struct Range {
    uint32_t begin, end;
  };

  static Way way_of(const Candidate& c) {
    return c.copy ? kCopy : c.distance == 1 ? kBeside : c.parallel != 0 ? kParallel : kNear;
  }

  Range neighbours(uint32_t v) const {
    return {first_[v], std::min(first_[v + 1], first_[v] + kMaxNeighbours)};
  }

  Range copies(uint32_t v) const;

  void remember(Way way) {
    for (size_t i = kWays - 1; i > 0; --i)
      ways_[i] = ways_[i - 1];
    ways_[0] = way;
  }

  /// Contexts of the question whether a candidate comes next.
  void select(const Candidate& c, uint32_t rank);
  /// The places of the neighbours of the vertex before.
  void start_candidates();
  /// Adds those beside the vertex before, which most often suffice.
  void find_beside();
  /// Adds the others.
  void find_others();
  void offer(uint32_t v);
  void offer_neighbours(uint32_t v);
  void sort_from(uint32_t first);
  Candidate look_at(uint32_t v) const;
  void append(uint32_t v);

  static constexpr size_t kWays = 3;

  const Vector<uint32_t>&vertex_coded_, &offsets_;
  Vector<uint32_t> first_, neighbours_;  ///< of vertex v: neighbours_[first_[v] ...], ascending
  Vector<uint32_t> first_face_, faces_;  ///< the polygon of each corner at a vertex, likewise
  Vector<Face> polygons_;
  Vector<uint32_t> place_;               ///< of each vertex, kNotYet before it has one
  Vector<uint32_t> order_;               ///< the vertices that have a place
  Vector<uint32_t> offered_;             ///< number of vertices that had a place when one was last
  uint32_t along_[kMaxNeighbours] = {};  ///< places of the neighbours of the vertex before
  uint32_t along_count_ = 0;
  uint32_t free_before_ = 0;  ///< neighbours of the vertex before without a place, up to seven
  Candidate candidates_[kMaxCandidates] = {};
  uint32_t candidate_count_ = 0;
  Way ways_[kWays] = {kJump, kJump, kJump};  ///< the latest is first
  MixedModel<7> model_{{3840, 24000, 3000, 2400, 720, 10240, 2205}, {40, 40}, 1};
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_VERTEX_WALK_H_
