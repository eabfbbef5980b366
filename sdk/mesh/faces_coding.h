// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The polygons of a mesh over its vertices, written once for encoder and decoder
// (spec/07-topology.md): every decision is coder.bit(model, truth), where a decoder ignores the truth
// and returns what it read. The truth comes from a Source, which only an encoder fills with meaning.
#ifndef ANICODEC_SDK_MESH_FACES_CODING_H_
#define ANICODEC_SDK_MESH_FACES_CODING_H_

#include "format/coding/symbol_model.h"
#include "format/records.h"
#include "sdk/mesh/copy_coding.h"
#include "sdk/mesh/gate_walk.h"
#include "sdk/mesh/topology.h"

#include <cstdint>
#include <numeric>
#include <utility>

namespace anicodec {

/// A decoder's knowledge of a mesh beforehand: nothing.
struct NoMesh : NoFaces, NoCopies {
  bool has_repeats() const { return false; }

  /// Polygons that the walk leaves out.
  uint32_t polygons_apart() const { return 0; }

  /// Coded vertex of the i-th copy that no face of the walk uses, ascending.
  uint32_t spare_copy(uint32_t) const { return 0; }

  uint32_t apart_corners(uint32_t) const { return 0; }

  /// A vertex of a polygon apart, in canonical order. Asked when all copies are known.
  uint32_t apart_vertex(uint32_t, uint32_t) const { return 0; }
};

template <class Coder, class Source>
class FacesCoding {
 public:
  FacesCoding(Coder& coder, Source& source, const Limits::Mesh& sizes, Topology* topology)
      : coder_(coder), source_(source), sizes_(sizes), t_(*topology) {}

  /// Fills the topology, in canonical order. Cost: O(corners + vertices).
  Status run() {
    const auto apart = static_cast<uint32_t>(
        corners_.code(coder_, static_cast<int32_t>(source_.polygons_apart())));
    if (apart > sizes_.polygons)
      return Status::kTopology;
    const bool repeats = coder_.bit(repeats_, source_.has_repeats());
    WalkedFaces faces;
    if (Status s = GateWalk<Coder, Source>(coder_, source_, sizes_.coded_vertices, sizes_.corners)
                       .run(sizes_.polygons - apart, sizes_.corners, repeats, &faces);
        s != Status::kOk)
      return s;
    t_.coded_vertices = sizes_.coded_vertices;
    t_.vertices_in_triangles = faces.vertices;
    if (Status s = make_triangles(faces); s != Status::kOk)
      return s;
    if (Status s = copies(std::move(faces)); s != Status::kOk)
      return s;
    return polygons_apart(apart);
  }

 private:
  bool alive() const {
    if constexpr (Coder::kDecodes)
      return coder_.ok();
    return true;
  }

  /// Each face as a fan from its first corner; a repeated one once.
  Status make_triangles(const WalkedFaces& faces) {
    uint64_t count = 0;
    const auto each_face = [&](auto&& take) {
      for (size_t f = 0; f < faces.repeats.size(); ++f) {
        if (!faces.repeats[f])
          take(faces.offsets[f], faces.offsets[f + 1]);
      }
    };
    each_face([&](uint32_t begin, uint32_t end) { count += end - begin - 2; });
    if (count != sizes_.triangles)
      return Status::kTopology;
    t_.triangles.clear();
    t_.triangles.reserve(size_t{3} * sizes_.triangles);
    each_face([&](uint32_t begin, uint32_t end) {
      for (uint32_t c = begin + 1; c + 1 < end; ++c) {
        for (const uint32_t corner : {begin, c, c + 1})
          t_.triangles.push_back(faces.corners[corner]);
      }
    });
    return Status::kOk;
  }

  /// Vertices out of coded vertices, and the polygons of the walk over them.
  Status copies(WalkedFaces&& faces) {
    const uint32_t loose = sizes_.coded_vertices - faces.vertices;
    const bool welded = sizes_.source_vertices != sizes_.coded_vertices;
    CornerCopies used;
    if (!welded) {
      used.vertices.assign(faces.vertices, 1);
    } else if (Status s = CopyCoding<Coder, Source>(coder_, source_, faces, &used)
                              .run(sizes_.source_vertices - loose);
               s != Status::kOk) {
      return s;
    }
    used.vertices.resize(sizes_.coded_vertices, 1);
    if (Status s = spare_copies(&used.vertices); s != Status::kOk)
      return s;
    t_.vertex_coded.clear();
    t_.vertex_coded.reserve(sizes_.source_vertices);
    Vector<uint32_t> first(sizes_.coded_vertices);
    for (uint32_t v = 0; v < sizes_.coded_vertices; ++v) {
      first[v] = static_cast<uint32_t>(t_.vertex_coded.size());
      t_.vertex_coded.insert(t_.vertex_coded.end(), used.vertices[v], v);
    }
    t_.polygon_offsets = std::move(faces.offsets);
    t_.polygon_corners = std::move(faces.corners);
    for (size_t c = 0; welded && c < t_.polygon_corners.size(); ++c)
      t_.polygon_corners[c] = first[t_.polygon_corners[c]] + used.corners[c];
    return Status::kOk;
  }

  /// Vertices that no face of the walk uses, although others of the same place are.
  Status spare_copies(Vector<uint32_t>* counts) {
    const auto so_far = std::accumulate(counts->begin(), counts->end(), uint64_t{0});
    uint32_t v = 0;
    for (uint32_t i = 0; so_far + i < sizes_.source_vertices; ++i) {
      const auto step = static_cast<uint32_t>(
          spare_.code(coder_, static_cast<int32_t>(source_.spare_copy(i) - v)));
      if (!alive())
        return Status::kEntropy;
      if (step >= sizes_.coded_vertices - v)
        return Status::kIndexRange;
      v += step;
      ++(*counts)[v];
    }
    return Status::kOk;
  }

  /// The remaining polygons as lists of vertices, each relative to the one before.
  Status polygons_apart(uint32_t count) {
    t_.polygon_offsets.reserve(size_t{sizes_.polygons} + 1);
    t_.polygon_corners.reserve(sizes_.corners);
    uint32_t before = 0;
    for (uint32_t p = 0; p < count; ++p) {
      const auto n = static_cast<uint32_t>(
          corners_.code(coder_, static_cast<int32_t>(source_.apart_corners(p))));
      if (n > sizes_.corners - t_.polygon_corners.size())
        return Status::kTopology;
      for (uint32_t i = 0; i < n; ++i) {
        const int64_t v =
            int64_t{before} +
            step_.code(coder_, static_cast<int32_t>(int64_t{source_.apart_vertex(p, i)} - before));
        if (v < 0 || v >= sizes_.source_vertices)
          return Status::kIndexRange;
        before = static_cast<uint32_t>(v);
        t_.polygon_corners.push_back(before);
        if (!alive())
          return Status::kEntropy;
      }
      t_.polygon_offsets.push_back(static_cast<uint32_t>(t_.polygon_corners.size()));
      if (!alive())
        return Status::kEntropy;
    }
    return t_.polygon_corners.size() == sizes_.corners ? Status::kOk : Status::kTopology;
  }

  Coder& coder_;
  Source& source_;
  const Limits::Mesh& sizes_;
  Topology& t_;
  AdaptiveBit repeats_;
  UnsignedModel corners_, spare_;
  SymbolModel<> step_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_FACES_CODING_H_
