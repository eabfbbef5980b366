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

/// The triangles as the decoder will see them, over renumbered points.
struct DecodedTriangles {
  Vector<uint32_t> triangles;
  std::vector<uint32_t> point_of;          ///< point of the manifold mesh of each of theirs
  std::vector<uint32_t> triangle_polygon;  ///< source polygon of each
};

/// Leaves the layout as it is where Draco does not give back what it took.
void code_by_draco(const ManifoldMesh& manifold, MeshLayout* layout, DecodedTriangles* decoded) {
  std::vector<uint32_t> order;
  layout->connectivity = encode_draco_mesh(manifold.points, manifold.triangles, {}, {}, &order);
  DracoMesh mesh;
  if (layout->connectivity.empty() ||
      decode_draco_mesh(layout->connectivity, manifold.points,
                        static_cast<uint32_t>(manifold.triangle_polygon.size()),
                        draco_components(0), &mesh) != Status::kOk)
    return;
  layout->coder = CoderId::kDraco;
  decoded->triangles = mesh.triangles;
  std::vector<uint32_t> back(mesh.triangles.size());
  std::transform(mesh.triangles.begin(), mesh.triangles.end(), back.begin(),
                 [&](uint32_t d) { return order[d]; });
  std::vector<uint32_t> match = match_triangles(manifold.triangles, back);
  for (size_t t = 0; t < match.size(); ++t)
    decoded->triangle_polygon[t] = manifold.triangle_polygon[match[t]];
  decoded->point_of = std::move(order);
}

DecodedTriangles code_connectivity(const ManifoldMesh& manifold, CoderId coder,
                                   MeshLayout* layout) {
  DecodedTriangles decoded{{manifold.triangles.begin(), manifold.triangles.end()},
                           std::vector<uint32_t>(manifold.points),
                           manifold.triangle_polygon};
  std::iota(decoded.point_of.begin(), decoded.point_of.end(), 0U);
  if (coder == CoderId::kDraco)
    code_by_draco(manifold, layout, &decoded);
  if (layout->coder == CoderId::kPlain)
    layout->connectivity = encode_plain_triangles(decoded.triangles);
  return decoded;
}

/// Numbers the coded vertices: by first point, then those without one. Returns that of each point.
std::vector<uint32_t> number_vertices(const Weld& weld, const ManifoldMesh& manifold,
                                      const std::vector<uint32_t>& point_of, MeshLayout* layout) {
  std::vector<uint32_t> coded_of(weld.representative.size(), kNone);
  const auto number = [&](uint32_t w) {
    if (coded_of[w] == kNone) {
      coded_of[w] = static_cast<uint32_t>(layout->coded_source.size());
      layout->coded_source.push_back(weld.representative[w]);
    }
    return coded_of[w];
  };
  std::vector<uint32_t> point_coded(manifold.points);
  for (uint32_t p = 0; p < manifold.points; ++p)
    point_coded[p] = number(manifold.point_vertex[point_of[p]]);
  for (uint32_t w = 0; w < coded_of.size(); ++w)
    number(w);
  for (uint32_t w : weld.welded)
    layout->source_coded.push_back(coded_of[w]);
  for (uint32_t w : manifold.point_vertex)
    layout->draco_points.push_back(coded_of[w]);
  layout->draco_triangles = manifold.triangles;
  return point_coded;
}

Limits::Mesh sizes_of(const MeshSequence& sequence, const ManifoldMesh& manifold,
                      const MeshLayout& layout) {
  Limits::Mesh sizes;
  sizes.source_vertices = sequence.vertex_count;
  sizes.coded_vertices = static_cast<uint32_t>(layout.coded_source.size());
  sizes.points = manifold.points;
  sizes.triangles = static_cast<uint32_t>(manifold.triangle_polygon.size());
  sizes.polygons = static_cast<uint32_t>(sequence.polygons.size());
  sizes.corners = static_cast<uint32_t>(sequence.polygons.corners.size());
  return sizes;
}

void code_details(const Vector<uint32_t>& triangles, DetailsEncoderSource* source,
                  MeshLayout* layout) {
  BinaryEncoder encoder;
  DetailsCoding<BinaryEncoder, DetailsEncoderSource> details(encoder, *source, layout->sizes,
                                                             triangles, &layout->topology);
  if (details.run() != Status::kOk)
    throw Error(ErrorKind::kInternal, "the mesh details could not be coded");
  layout->details = encoder.finish();
  source->number_the_rest();
}

/// Codes where vertices come from. Returns the canonical number of each source vertex.
Vector<uint32_t> code_vertex_map(const DetailsEncoderSource& source, MeshLayout* layout) {
  Vector<uint32_t> canonical(layout->source_coded.size());
  layout->vertex_source.resize(canonical.size());
  for (uint32_t v = 0; v < canonical.size(); ++v) {
    canonical[v] = source.canonical(v);
    layout->vertex_source[canonical[v]] = v;
  }
  BinaryEncoder encoder;
  VertexWalk(layout->topology).code(encoder, &layout->vertex_source);
  layout->vertex_map = encoder.finish();
  return canonical;
}

/// Codes where polygons come from, and which of their corners is the source's first.
void code_face_map(const Polygons& polygons, const std::vector<uint32_t>& triangle_polygon,
                   const std::vector<uint32_t>& apart, const Vector<uint32_t>& canonical,
                   MeshLayout* layout) {
  Vector<uint32_t>& source_of = layout->polygon_source;
  source_of = canonical_polygons(triangle_polygon, apart, polygons.size());
  Vector<uint32_t>& first = layout->polygon_first;
  first.assign(source_of.size(), 0);
  for (size_t i = 0; i < source_of.size(); ++i) {
    std::span<const uint32_t> source = polygons[source_of[i]];
    uint32_t begin = layout->topology.polygon_offsets[i];
    // A polygon kept apart has its corners in the source's order already.
    while (i + apart.size() < source_of.size() && first[i] < source.size() &&
           layout->topology.polygon_corners[begin + first[i]] != canonical[source[0]])
      ++first[i];
  }
  BinaryEncoder encoder;
  code_permutation(encoder, layout->sizes.polygons, &source_of);
  code_rotations(encoder, layout->topology.polygon_offsets, &first);
  layout->face_map = encoder.finish();
}

}  // namespace

MeshLayout lay_out_mesh(const MeshSequence& sequence, CoderId coder) {
  const Weld weld = weld_trajectories(sequence);
  const ManifoldMesh manifold = make_manifold(sequence.polygons, weld.welded);
  MeshLayout layout;
  layout.name = sequence.mesh_name;
  const DecodedTriangles decoded = code_connectivity(manifold, coder, &layout);
  const std::vector<uint32_t> point_coded =
      number_vertices(weld, manifold, decoded.point_of, &layout);
  layout.sizes = sizes_of(sequence, manifold, layout);
  DetailsEncoderSource source(sequence.polygons, layout.source_coded, point_coded,
                              decoded.triangle_polygon, manifold.apart,
                              layout.sizes.coded_vertices);
  code_details(decoded.triangles, &source, &layout);
  const Vector<uint32_t> canonical = code_vertex_map(source, &layout);
  code_face_map(sequence.polygons, decoded.triangle_polygon, manifold.apart, canonical, &layout);
  return layout;
}

Bytes encode_with_poses(const MeshLayout& layout, std::span<const Vector<int32_t>> poses) {
  return encode_draco_mesh(layout.sizes.points, layout.draco_triangles, poses, layout.draco_points);
}

}  // namespace anicodec
