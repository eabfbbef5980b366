// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_MESH_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_MESH_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/alembic/abc_archive.h"
#include "tools/io/alembic/abc_geom_params.h"
#include "tools/io/alembic/abc_scene.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Faces as an archive has them, clockwise seen from outside, over a number of points.
struct AbcTopology {
  Polygons polygons;
  uint32_t vertex_count = 0;

  bool is_empty() const { return vertex_count == 0; }

  bool operator==(const AbcTopology&) const = default;
};

/// The corners of polygons in the opposite order around each: for every corner, which it was.
std::vector<uint32_t> reversed_corners(const Polygons& polygons);

/// An object of the schema PolyMesh or SubD.
class AbcMesh {
 public:
  /// Throws Error(kInput) where positions or faces are not there. The archive must outlive it.
  AbcMesh(const AbcArchive& archive, const AbcObject& object, const AbcNote& note);

  const AbcSamples& positions() const { return positions_; }

  /// Which of topologies() a time has; faces and points are compared, whether they are stored
  /// again or not. Throws Error(kInput) for faces that do not fit their points.
  uint32_t topology_at(double time);

  /// All that topology_at() has met.
  const std::vector<AbcTopology>& topologies() const { return topologies_; }

  /// Positions at a time, vertices x 3 in the space of the object.
  void read_positions(double time, std::span<float> out) const;

  /// Names of face sets, and which of them each polygon belongs to; the first where several claim
  /// one.
  PolygonLabels face_sets(double time, size_t polygons, const AbcNote& note) const;

  const AbcGeomParams& params() const { return params_; }

  /// Properties with samples, for the times of a clip.
  std::vector<const AbcProperty*> timed() const;

 private:
  struct FaceSet {
    std::string name;
    AbcSamples faces;
  };

  AbcMesh(const AbcArchive& archive, const AbcObject& object, const AbcCompound& geometry,
          const AbcNote& note);
  void find_face_sets(const AbcObject& object, const AbcNote& note);
  AbcTopology read_topology(uint32_t counts, uint32_t indices, uint32_t vertices) const;

  const AbcArchive& archive_;
  std::string path_;
  AbcSamples positions_, counts_, indices_;
  AbcGeomParams params_;
  std::vector<FaceSet> face_sets_;
  std::vector<AbcTopology> topologies_;
  /// Offsets of counts and indices, number of points -> topology.
  std::map<std::array<uint64_t, 3>, uint32_t> known_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_MESH_H_
