// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The details of a mesh, written once for encoder and decoder (spec/07-topology.md): every decision
// is coder.bit(model, truth), where a decoder ignores the truth and returns what it read. The truth
// comes from a Source, which only an encoder fills with meaning.
#ifndef ANICODEC_SDK_MESH_DETAILS_CODING_H_
#define ANICODEC_SDK_MESH_DETAILS_CODING_H_

#include "format/binary_coder.h"
#include "format/memory.h"
#include "format/records.h"
#include "format/symbol_model.h"
#include "sdk/mesh/half_edges.h"
#include "sdk/mesh/topology.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace anicodec {

/// What a decoder knows about the truth: nothing.
struct DetailsDecoderSource {
  bool is_repeated_point(uint32_t) { return false; }

  uint32_t coded_vertex_of(uint32_t) { return 0; }

  uint32_t copies(uint32_t) { return 1; }

  bool welded() { return false; }

  bool has_polygons() { return false; }

  bool same_polygon(uint32_t, uint32_t) { return false; }

  /// Copy number of the vertex at a corner of triangle t that uses coded vertex c; `used` if new.
  uint32_t copy(uint32_t, uint32_t, uint32_t used) { return used; }

  uint32_t apart_corners(uint32_t) { return 0; }

  uint32_t apart_vertex(uint32_t, uint32_t) { return 0; }
};

/// Polygons with more corners are kept apart: joining takes time quadratic in a polygon's corners.
inline constexpr uint32_t kMaxJoinedCorners = 1024;

template <class Coder, class Source>
class DetailsCoding {
 public:
  DetailsCoding(Coder& coder, Source& source, const Limits::Mesh& sizes,
                const Vector<uint32_t>& triangles, Topology* topology)
      : coder_(coder), source_(source), sizes_(sizes), triangles_(triangles), t_(*topology) {}

  Status run() {
    for (Status status : {splits(), welds()}) {
      if (status != Status::kOk)
        return status;
    }
    if (Status status = polygons(); status != Status::kOk)
      return status;
    return polygons_apart();
  }

 private:
  /// Coded vertex of each point: a new one, or an earlier one counted back from the newest.
  Status splits() {
    uint32_t count = 0;
    bool repeated = false;
    t_.point_vertex.resize(sizes_.points);
    for (uint32_t p = 0; p < sizes_.points; ++p) {
      repeated = coder_.bit(repeated_[repeated], source_.is_repeated_point(p));
      if (!repeated) {
        t_.point_vertex[p] = count++;
        continue;
      }
      int32_t back = split_distance_.code(
          coder_, static_cast<int32_t>(count - 1 - source_.coded_vertex_of(p)));
      if (!alive(p))
        return Status::kEntropy;
      if (static_cast<uint32_t>(back) >= count)
        return Status::kTopology;
      t_.point_vertex[p] = count - 1 - static_cast<uint32_t>(back);
    }
    if (count > sizes_.coded_vertices)
      return Status::kTopology;
    t_.coded_vertices = sizes_.coded_vertices;
    t_.vertices_in_triangles = count;
    t_.triangles.resize(triangles_.size());
    for (size_t i = 0; i < triangles_.size(); ++i)
      t_.triangles[i] = t_.point_vertex[triangles_[i]];
    return Status::kOk;
  }

  /// Number of copies of each coded vertex; the copies get consecutive vertex numbers.
  Status welds() {
    bool welded = coder_.bit(flag_[0], source_.welded());
    first_copy_.resize(size_t{sizes_.coded_vertices} + 1);
    t_.vertex_coded.clear();
    t_.vertex_coded.reserve(sizes_.source_vertices);
    int32_t before = 0;
    for (uint32_t c = 0; c < sizes_.coded_vertices; ++c) {
      first_copy_[c] = static_cast<uint32_t>(t_.vertex_coded.size());
      if (welded) {
        before =
            copies_[std::min(before, 3)].code(coder_, static_cast<int32_t>(source_.copies(c) - 1));
        if (!alive(c))
          return Status::kEntropy;
      }
      if (static_cast<uint32_t>(before) >= sizes_.source_vertices - t_.vertex_coded.size())
        return Status::kTopology;
      t_.vertex_coded.insert(t_.vertex_coded.end(), static_cast<size_t>(before) + 1, c);
    }
    first_copy_.back() = static_cast<uint32_t>(t_.vertex_coded.size());
    used_.assign(sizes_.coded_vertices, 0);
    recent_.assign(welded ? sizes_.coded_vertices : 0, 0);
    return t_.vertex_coded.size() == sizes_.source_vertices ? Status::kOk : Status::kTopology;
  }

  /// Joins triangles into polygons: from each triangle not yet used, across border edges.
  Status polygons() {
    t_.polygon_offsets.clear();
    t_.polygon_offsets.reserve(size_t{sizes_.polygons} + 1);
    t_.polygon_offsets.push_back(0);
    t_.polygon_corners.clear();
    t_.polygon_corners.reserve(sizes_.corners);
    auto count = static_cast<uint32_t>(triangles_.size() / 3);
    if (!coder_.bit(flag_[1], source_.has_polygons())) {
      for (uint32_t t = 0; t < count; ++t) {
        for (uint32_t i = 0; i < 3; ++i)
          add_corner(t, t_.triangles[size_t{3} * t + i]);
        if (!close_polygon())
          return Status::kTopology;
      }
      return alive(0) ? Status::kOk : Status::kEntropy;
    }
    // Across the edge that leads from a corner to the next one: the first such triangle.
    const Vector<uint32_t> opposite = HalfEdges(sizes_.points, triangles_)
                                          .opposites([this](uint32_t c) { return triangles_[c]; });
    Vector<bool> used(count, false);
    Vector<uint32_t> border;  // corners: where each border edge of the polygon starts
    uint32_t size_before = 0;
    for (uint32_t t = 0; t < count; ++t) {
      if (used[t])
        continue;
      used[t] = true;
      border.assign({3 * t, 3 * t + 1, 3 * t + 2});
      for (;;) {
        auto size = static_cast<uint32_t>(border.size());
        uint32_t taken = size;
        uint32_t options = 0, wanted = size;
        for (uint32_t e = 0; e < size; ++e) {
          uint32_t o = opposite[border[e]];
          bool open = o != HalfEdges::kNone && !used[o / 3];
          options += open;
          if (open && wanted == size && source_.same_polygon(t, o / 3))
            wanted = e;
        }
        if (options == 0 || size >= kMaxJoinedCorners ||
            !coder_.bit(more_[std::min(size, 7U)][std::min(size_before, 7U)], wanted != size))
          break;
        uint32_t rank = 0;
        for (uint32_t e = 0; e < size && taken == size; ++e) {
          uint32_t o = opposite[border[e]];
          if (o == HalfEdges::kNone || used[o / 3])
            continue;
          if (++rank == options ||
              coder_.bit(edge_[std::min(size, 7U)][std::min(e, 7U)], e == wanted))
            taken = e;
        }
        uint32_t o = opposite[border[taken]];
        used[o / 3] = true;
        border[taken] = next_corner(o);
        border.insert(border.begin() + static_cast<ptrdiff_t>(taken) + 1,
                      next_corner(next_corner(o)));
        if (!alive(t))
          return Status::kEntropy;
      }
      size_before = static_cast<uint32_t>(border.size());
      for (uint32_t corner : border)
        add_corner(t, t_.triangles[corner]);
      if (!close_polygon())
        return Status::kTopology;
    }
    return Status::kOk;
  }

  /// Which copy of a coded vertex a corner uses: the next new one, or by how recently it was used.
  void add_corner(uint32_t t, uint32_t c) {
    uint32_t copies = first_copy_[c + 1] - first_copy_[c];
    uint32_t chosen = 0;
    if (copies > 1) {
      uint32_t wanted = source_.copy(t, c, used_[c]);
      bool fresh = used_[c] < copies && (used_[c] == 0 || coder_.bit(fresh_[std::min(used_[c], 7U)],
                                                                     wanted == used_[c]));
      if (fresh) {
        chosen = used_[c]++;
      } else {
        chosen = recent_[c];
        if (used_[c] > 1 && !coder_.bit(again_, wanted == recent_[c])) {
          chosen = static_cast<uint32_t>(which_.code(coder_, static_cast<int32_t>(wanted)));
          chosen = std::min(chosen, used_[c] - 1);
        }
      }
      recent_[c] = chosen;
    }
    t_.polygon_corners.push_back(first_copy_[c] + chosen);
  }

  bool close_polygon() {
    t_.polygon_offsets.push_back(static_cast<uint32_t>(t_.polygon_corners.size()));
    return t_.polygon_offsets.size() <= size_t{sizes_.polygons} + 1 &&
           t_.polygon_corners.size() <= sizes_.corners;
  }

  /// The remaining polygons as lists of vertices, each relative to the one before.
  Status polygons_apart() {
    auto first = static_cast<uint32_t>(t_.polygon_offsets.size() - 1);
    uint32_t before = 0;
    for (uint32_t p = first; p < sizes_.polygons; ++p) {
      auto n = static_cast<uint32_t>(
          corners_.code(coder_, static_cast<int32_t>(source_.apart_corners(p - first))));
      if (n > sizes_.corners - t_.polygon_corners.size())
        return Status::kTopology;
      for (uint32_t i = 0; i < n; ++i) {
        int64_t v =
            int64_t{before} +
            step_.code(coder_,
                       static_cast<int32_t>(int64_t{source_.apart_vertex(p - first, i)} - before));
        if (v < 0 || v >= sizes_.source_vertices)
          return Status::kIndexRange;
        before = static_cast<uint32_t>(v);
        t_.polygon_corners.push_back(before);
        if (!alive(i))
          return Status::kEntropy;
      }
      t_.polygon_offsets.push_back(static_cast<uint32_t>(t_.polygon_corners.size()));
      if (!alive(0))
        return Status::kEntropy;
    }
    return t_.polygon_corners.size() == sizes_.corners ? Status::kOk : Status::kTopology;
  }

  /// A decoder whose stream ran out stops soon; an encoder is always alive.
  bool alive(uint32_t) const {
    if constexpr (Coder::kDecodes)
      return coder_.ok();
    return true;
  }

  Coder& coder_;
  Source& source_;
  const Limits::Mesh& sizes_;
  const Vector<uint32_t>& triangles_;
  Topology& t_;
  Vector<uint32_t> first_copy_, used_, recent_;

  AdaptiveBit flag_[2], repeated_[2], more_[8][8], edge_[8][8], fresh_[8], again_;
  UnsignedModel split_distance_, copies_[4], which_, corners_;
  SymbolModel<> step_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_DETAILS_CODING_H_
