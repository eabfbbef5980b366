// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ABC_GEOM_PARAMS_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ABC_GEOM_PARAMS_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/alembic/abc_archive.h"
#include "tools/io/alembic/abc_scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Values beside the positions as an archive has them: of vertices, corners, faces or the whole
/// mesh, plain or as indices into them.
struct AbcGeomParam {
  AttributeKind kind = AttributeKind::kCustom;
  std::string name;
  std::string scope;  ///< con, uni, var, vtx, fvr
  AbcSamples values;
  std::optional<AbcSamples> indices;

  /// Numbers of an element.
  uint32_t components() const { return values.property().extent; }
};

/// The kind of element that a value belongs to.
enum class AbcDomain : uint8_t { kNone, kMesh, kFace, kVertex, kCorner };

/// Values of a param at one time, an element for each vertex, corner ...
struct AbcValues {
  AbcDomain domain = AbcDomain::kNone;  ///< kNone: no values, or of an unknown number
  FrameArray values;                    ///< elements x components
};

/// The texture coordinates, normals, colours and further numbers of a mesh.
class AbcGeomParams {
 public:
  /// Takes `uv`, `N` and what is in `.arbGeomParams`: sets of texture coordinates, colours and
  /// numbers; notes what is none of these. Throws Error(kInput). The archive must outlive it.
  AbcGeomParams(const AbcArchive& archive, const AbcObject& object, const AbcCompound& geometry,
                const AbcNote& note);

  const std::vector<AbcGeomParam>& all() const { return params_; }

  /// Values at a time for a mesh of some polygons, indices resolved. Throws Error(kInput) for
  /// indices out of range.
  AbcValues values_at(const AbcGeomParam& param, double time, const Polygons& polygons,
                      uint32_t vertices) const;

  /// The same as an attribute: of vertices or corners, in the order of the archive's corners. None
  /// where there are no values, not all finite ones, or numbers that are no attribute's (those of
  /// faces, corners or the mesh that are no colours, normals or texture coordinates).
  std::optional<Attribute> attribute_at(const AbcGeomParam& param, double time,
                                        const Polygons& polygons, uint32_t vertices) const;

 private:
  void add(AttributeKind kind, std::string name, const AbcProperty& property);
  void add_arbitrary(const AbcProperty& property, const AbcNote& note);

  const AbcArchive& archive_;
  std::vector<AbcGeomParam> params_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ABC_GEOM_PARAMS_H_
