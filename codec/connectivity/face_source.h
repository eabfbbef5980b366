// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_FACE_SOURCE_H_
#define ANICODEC_CODEC_CONNECTIVITY_FACE_SOURCE_H_

#include "codec/connectivity/weld.h"
#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// Which face begins the walk, and each part that the walk has not reached: the next of the source,
/// from its first or from its middle on, or one at the vertex of the most faces.
enum class SeedOrder { kSource, kMiddle, kFullest };

/// The polygons of a clip as the coder of faces asks for them (see NoMesh of
/// sdk/mesh/faces_coding.h), and the numbering that comes out of it. Polygons of the same corners
/// in the same cyclic order are one face with repeats; those with fewer than three corners, or with
/// a welded vertex twice, are kept apart.
class FaceSource {
 public:
  /// Both must outlive it. Cost: O(corners log corners).
  FaceSource(const Polygons& polygons, const Weld& weld);

  /// Triangles of all faces, each as a fan, repeats left out.
  uint32_t triangles() const { return triangles_; }

  /// Forgets what was asked for, so that everything can be coded again, from other seeds. To be
  /// called first. O(corners log corners).
  void begin(SeedOrder order);

  // Asked by the walk.
  bool find(uint32_t a, uint32_t b);
  void find_seed();

  uint32_t corners() const { return size_of(face_); }

  uint32_t vertex(uint32_t k) const { return number_[welded_at(k)]; }

  void set_vertex(uint32_t k, uint32_t number);
  uint32_t finish();

  // Asked by the coder of copies.
  bool repeats_copies(uint32_t polygon) const;

  uint32_t copy(uint32_t corner) const { return copy_of_[corner_vertices_[corner]]; }

  void set_copy(uint32_t corner, uint32_t copy);

  // Facts beside the walk.
  bool has_repeats() const { return has_repeats_; }

  uint32_t polygons_apart() const { return static_cast<uint32_t>(apart_.size()); }

  uint32_t spare_copy(uint32_t i);

  uint32_t apart_corners(uint32_t i) const {
    return static_cast<uint32_t>(polygons_[apart_[i]].size());
  }

  uint32_t apart_vertex(uint32_t i, uint32_t k) { return canonical()[polygons_[apart_[i]][k]]; }

  // The numbering, once everything was asked for.
  /// Canonical number of each source vertex.
  const std::vector<uint32_t>& canonical();
  /// Welded vertex of each coded one.
  const std::vector<uint32_t>& coded_welded();

  /// Source polygon of each canonical one, and which of its corners is the source's first.
  struct PolygonPlace {
    uint32_t polygon, first;
  };

  std::vector<PolygonPlace> polygon_places() const;

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// A side of a face: the vertex it leads to, the corner it starts at, and the next side to the
  /// same vertex whose face is not done; `next` is used of the first such side.
  struct SideItem {
    uint32_t to;
    uint32_t corner;
    uint32_t next;
  };

  uint32_t size_of(uint32_t face) const { return offsets_[face + 1] - offsets_[face]; }

  uint32_t welded_at(uint32_t k) const {
    const uint32_t n = corners();
    return corners_[offsets_[face_] + (start_ + k) % n];
  }

  void gather_faces();
  void index_sides();
  void order_seeds(SeedOrder order);
  void complete();

  const Polygons& polygons_;
  const Weld& weld_;
  std::vector<uint32_t> apart_;
  std::vector<uint32_t> offsets_{0}, corners_;      ///< faces over welded vertices
  std::vector<uint32_t> instances_, instance_end_;  ///< source polygons of each face
  std::vector<uint32_t> corner_face_;
  std::vector<uint32_t> side_begin_;  ///< of the sides that start at a welded vertex
  std::vector<SideItem> sides_;
  uint32_t triangles_ = 0;
  bool has_repeats_ = false;

  std::vector<bool> done_;

  struct Seed {
    uint32_t face, start;  ///< and which of its corners comes first
  };

  std::vector<Seed> seeds_;  ///< all faces, in the order in which they are to be seeds
  size_t seed_ = 0;
  uint32_t face_ = 0, start_ = 0;
  std::vector<uint32_t> number_, coded_welded_;  ///< coded number of a welded vertex, and back
  std::vector<PolygonPlace> places_;             ///< of the walk's polygons
  std::vector<uint32_t> place_corners_;          ///< where their corners begin
  std::vector<uint32_t> corner_vertices_;        ///< source vertex at each of their corners
  std::vector<uint32_t> copy_of_, spare_, canonical_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_FACE_SOURCE_H_
