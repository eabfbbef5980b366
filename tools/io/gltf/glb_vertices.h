// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLB_VERTICES_H_
#define ANICODEC_TOOLS_IO_GLTF_GLB_VERTICES_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// A part of the clip, or all that is in none: a run of the vertices of a GLB.
struct GlbObject {
  uint32_t part = kNoLabel;
  uint32_t first = 0, count = 0;
};

/// The triangles of an object that are of a material: three corners each, numbered within the
/// object.
struct GlbTriangles {
  uint32_t object = 0, material = kNoLabel;
  std::vector<uint32_t> corners;
};

/// The vertices of a GLB: those of the clip, object by object, where corners at one have different
/// attributes, normals or parts more than once. Vertices without polygon go with the one before.
class GlbVertices {
 public:
  /// `attributes`: those of the clip, in all frames where they move.
  GlbVertices(const MeshSequence& clip, const std::vector<Attribute>& attributes);

  /// True when no two corners at a vertex share a normal and all polygons are triangles: a GLB says so by
  /// having no normals.
  static bool is_flat(const MeshSequence& clip);

  /// The attributes of a GLB: two texture coordinates, three or four of a colour.
  static bool is_written(const Attribute& attribute);

  const std::vector<GlbObject>& objects() const { return objects_; }

  /// One for each object and material, in order of their first polygon; polygons are cut by `positions`, of
  /// a frame of the clip (corner_triangles()).
  std::vector<GlbTriangles> triangles(const MeshSequence& clip,
                                      std::span<const float> positions) const;

  /// A corner of the clip that each vertex stands for, or kNoCorner.
  const std::vector<uint32_t>& corners() const { return corner_; }

  /// The vertex of the GLB that a corner of the clip has.
  uint32_t of_corner(uint32_t corner) const { return of_corner_[corner]; }

  /// Values of the clip's vertices at those of the GLB.
  std::vector<float> of_vertices(std::span<const float> values, size_t components) const;

  /// Values of corners at the vertices of the GLB; 0 where there is no corner.
  std::vector<float> of_corners(std::span<const float> values, size_t components) const;

  static constexpr uint32_t kNoCorner = UINT32_MAX;

 private:
  void split_vertices(const MeshSequence& clip, const std::vector<Attribute>& attributes,
                      const std::vector<uint32_t>& part_of_corner);
  void sort_by_object(const std::vector<uint32_t>& part_of_corner);

  std::vector<uint32_t> source_;     ///< vertex of the clip
  std::vector<uint32_t> corner_;     ///< a corner of the clip, or kNoCorner
  std::vector<uint32_t> of_corner_;  ///< vertex of the GLB at each corner of the clip
  std::vector<uint32_t> object_of_;  ///< of each vertex
  std::vector<GlbObject> objects_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLB_VERTICES_H_
