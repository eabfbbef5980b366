// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/mesh_layout.h"

#include "codec/connectivity/draco_encode.h"
#include "codec/connectivity/manifold_mesh.h"
#include "codec/sequence/error.h"
#include "sdk/mesh/details_coding.h"
#include "sdk/mesh/draco_mesh.h"
#include "sdk/mesh/map_coding.h"
#include "sdk/mesh/plain_coding.h"
#include "sdk/mesh/vertex_walk.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace anicodec {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

/// A triangle rotated so that its smallest point comes first: equal for equal oriented triangles.
std::array<uint32_t, 3> rotated(const uint32_t* t) {
  std::array<uint32_t, 3> r{t[0], t[1], t[2]};
  std::rotate(r.begin(), std::min_element(r.begin(), r.end()), r.end());
  return r;
}

/// For each triangle of `decoded` the one of `source` with the same points.
std::vector<uint32_t> match_triangles(const std::vector<uint32_t>& source,
                                      const std::vector<uint32_t>& decoded) {
  auto sorted = [](const std::vector<uint32_t>& triangles) {
    std::vector<std::pair<std::array<uint32_t, 3>, uint32_t>> keys(triangles.size() / 3);
    for (uint32_t t = 0; t < keys.size(); ++t)
      keys[t] = {rotated(&triangles[size_t{3} * t]), t};
    std::sort(keys.begin(), keys.end());
    return keys;
  };
  auto a = sorted(source), b = sorted(decoded);
  std::vector<uint32_t> match(a.size());
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i].first != b[i].first)
      throw Error(ErrorKind::kInternal, "the connectivity coder changed a triangle");
    match[b[i].second] = a[i].second;
  }
  return match;
}

/// The truth behind the details of a mesh (see DetailsDecoderSource), and the numbering that comes
/// out of it.
class DetailsEncoderSource {
 public:
  DetailsEncoderSource(const Polygons& polygons, const std::vector<uint32_t>& source_coded,
                       const std::vector<uint32_t>& point_coded,
                       const std::vector<uint32_t>& triangle_polygon,
                       const std::vector<uint32_t>& apart, uint32_t coded)
      : polygons_(polygons),
        source_coded_(source_coded),
        point_coded_(point_coded),
        triangle_polygon_(triangle_polygon),
        apart_(apart),
        copies_(coded, 0),
        seen_(coded, false),
        copy_of_(source_coded.size(), kNone),
        used_(coded, 0),
        first_copy_(coded) {
    for (uint32_t c : source_coded)
      ++copies_[c];
    std::exclusive_scan(copies_.begin(), copies_.end(), first_copy_.begin(), 0U);
    for (uint32_t p : triangle_polygon)
      has_polygons_ |= polygons[p].size() != 3;
  }

  bool is_repeated_point(uint32_t p) {
    bool seen = seen_[point_coded_[p]];
    seen_[point_coded_[p]] = true;
    return seen;
  }

  uint32_t coded_vertex_of(uint32_t p) const { return point_coded_[p]; }

  uint32_t copies(uint32_t c) const { return copies_[c]; }

  bool welded() const { return copies_.size() != source_coded_.size(); }

  bool has_polygons() const { return has_polygons_; }

  bool same_polygon(uint32_t t, uint32_t u) const {
    return triangle_polygon_[t] == triangle_polygon_[u];
  }

  uint32_t copy(uint32_t t, uint32_t c, uint32_t) {
    for (uint32_t v : polygons_[triangle_polygon_[t]]) {
      if (source_coded_[v] == c)
        return number(v);
    }
    throw Error(ErrorKind::kInternal, "a polygon lost a vertex");
  }

  uint32_t apart_corners(uint32_t i) {
    number_the_rest();
    return static_cast<uint32_t>(polygons_[apart_[i]].size());
  }

  uint32_t apart_vertex(uint32_t i, uint32_t corner) const {
    return canonical(polygons_[apart_[i]][corner]);
  }

  /// Canonical number of a source vertex, once all copies are numbered.
  uint32_t canonical(uint32_t v) const { return first_copy_[source_coded_[v]] + copy_of_[v]; }

  /// Copies that no polygon corner uses, or only polygons kept apart, follow in the source's order.
  void number_the_rest() {
    if (!all_numbered_) {
      for (uint32_t v = 0; v < copy_of_.size(); ++v)
        number(v);
      all_numbered_ = true;
    }
  }

 private:
  uint32_t number(uint32_t v) {
    if (copy_of_[v] == kNone)
      copy_of_[v] = used_[source_coded_[v]]++;
    return copy_of_[v];
  }

  const Polygons& polygons_;
  const std::vector<uint32_t>&source_coded_, &point_coded_, &triangle_polygon_, &apart_;
  std::vector<uint32_t> copies_;
  std::vector<bool> seen_;
  std::vector<uint32_t> copy_of_, used_, first_copy_;
  bool has_polygons_ = false, all_numbered_ = false;
};

/// Source polygon of each canonical polygon, in the order in which the details rebuild them.
Vector<uint32_t> canonical_polygons(const std::vector<uint32_t>& triangle_polygon,
                                    const std::vector<uint32_t>& apart, size_t count) {
  Vector<uint32_t> order;
  std::vector<bool> seen(count, false);
  for (const auto& list : {triangle_polygon, apart}) {
    for (uint32_t p : list) {
      if (!seen[p]) {
        seen[p] = true;
        order.push_back(p);
      }
    }
  }
  return order;
}

}  // namespace

MeshLayout lay_out_mesh(const MeshSequence& sequence, CoderId coder) {
  Weld weld = weld_trajectories(sequence);
  ManifoldMesh manifold = make_manifold(sequence.polygons, weld.welded);
  auto triangle_count = static_cast<uint32_t>(manifold.triangle_polygon.size());

  MeshLayout layout;
  layout.name = sequence.mesh_name;
  Vector<uint32_t> triangles(manifold.triangles.begin(),
                             manifold.triangles.end());  // as the decoder will see them,
  std::vector<uint32_t> point_of(manifold.points);       // over renumbered points
  std::iota(point_of.begin(), point_of.end(), 0U);
  std::vector<uint32_t> triangle_polygon = manifold.triangle_polygon;
  if (coder == CoderId::kDraco) {
    std::vector<uint32_t> order;
    layout.connectivity = encode_draco_mesh(manifold.points, manifold.triangles, {}, {}, &order);
    DracoMesh decoded;
    if (!layout.connectivity.empty() &&
        decode_draco_mesh(layout.connectivity, manifold.points, triangle_count, draco_components(0),
                          &decoded) == Status::kOk) {
      layout.coder = CoderId::kDraco;
      point_of = order;
      triangles = decoded.triangles;
      std::vector<uint32_t> back(triangles.size());
      std::transform(triangles.begin(), triangles.end(), back.begin(),
                     [&](uint32_t d) { return order[d]; });
      std::vector<uint32_t> match = match_triangles(manifold.triangles, back);
      for (size_t t = 0; t < match.size(); ++t)
        triangle_polygon[t] = manifold.triangle_polygon[match[t]];
    }
  }
  if (layout.coder == CoderId::kPlain)
    layout.connectivity = encode_plain_triangles(triangles);

  // Coded vertices: by first point, then those without one.
  auto welded_count = static_cast<uint32_t>(weld.representative.size());
  std::vector<uint32_t> coded_of(welded_count, kNone);
  std::vector<uint32_t> point_coded(manifold.points);
  auto number = [&](uint32_t w) {
    if (coded_of[w] == kNone) {
      coded_of[w] = static_cast<uint32_t>(layout.coded_source.size());
      layout.coded_source.push_back(weld.representative[w]);
    }
    return coded_of[w];
  };
  for (uint32_t p = 0; p < manifold.points; ++p)
    point_coded[p] = number(manifold.point_vertex[point_of[p]]);
  for (uint32_t w = 0; w < welded_count; ++w)
    number(w);
  layout.source_coded.resize(sequence.vertex_count);
  for (uint32_t v = 0; v < sequence.vertex_count; ++v)
    layout.source_coded[v] = coded_of[weld.welded[v]];
  layout.draco_points.resize(manifold.points);
  for (uint32_t p = 0; p < manifold.points; ++p)
    layout.draco_points[p] = coded_of[manifold.point_vertex[p]];
  layout.draco_triangles = manifold.triangles;

  Limits::Mesh& sizes = layout.sizes;
  sizes.source_vertices = sequence.vertex_count;
  sizes.coded_vertices = welded_count;
  sizes.points = manifold.points;
  sizes.triangles = triangle_count;
  sizes.polygons = static_cast<uint32_t>(sequence.polygons.size());
  sizes.corners = static_cast<uint32_t>(sequence.polygons.corners.size());

  DetailsEncoderSource truth(sequence.polygons, layout.source_coded, point_coded, triangle_polygon,
                             manifold.apart, welded_count);
  BinaryEncoder encoder;
  DetailsCoding<BinaryEncoder, DetailsEncoderSource> details(encoder, truth, sizes, triangles,
                                                             &layout.topology);
  if (details.run() != Status::kOk)
    throw Error(ErrorKind::kInternal, "the mesh details could not be coded");
  layout.details = encoder.finish();
  truth.number_the_rest();

  Vector<uint32_t>& map = layout.vertex_source;
  map.resize(sequence.vertex_count);
  Vector<uint32_t> canonical(sequence.vertex_count);
  for (uint32_t v = 0; v < sequence.vertex_count; ++v) {
    canonical[v] = truth.canonical(v);
    map[canonical[v]] = v;
  }
  BinaryEncoder map_encoder;
  VertexWalk(layout.topology).code(map_encoder, &map);
  layout.vertex_map = map_encoder.finish();

  Vector<uint32_t>& place = layout.polygon_source;
  place = canonical_polygons(triangle_polygon, manifold.apart, sequence.polygons.size());
  Vector<uint32_t>& first = layout.polygon_first;
  first.assign(place.size(), 0);
  for (size_t i = 0; i < place.size(); ++i) {
    std::span<const uint32_t> source = sequence.polygons[place[i]];
    uint32_t begin = layout.topology.polygon_offsets[i];
    // A polygon kept apart has its corners in the source's order already.
    while (i + manifold.apart.size() < place.size() && first[i] < source.size() &&
           layout.topology.polygon_corners[begin + first[i]] != canonical[source[0]])
      ++first[i];
  }
  BinaryEncoder face_encoder;
  code_permutation(face_encoder, sizes.polygons, &place);
  code_rotations(face_encoder, layout.topology.polygon_offsets, &first);
  layout.face_map = face_encoder.finish();
  return layout;
}

Bytes encode_with_poses(const MeshLayout& layout, std::span<const Vector<int32_t>> poses) {
  return encode_draco_mesh(layout.sizes.points, layout.draco_triangles, poses, layout.draco_points);
}

}  // namespace anicodec
