// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_POLY_MESH_OUTPUT_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_POLY_MESH_OUTPUT_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/scene.h"
#include "tools/io/alembic/abc_output.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// One connectivity of an object: a mesh or a part of one.
class AbcLook {
 public:
  /// All of a mesh, which must outlive the look, or some members of it.
  explicit AbcLook(const MeshSequence& mesh);
  AbcLook(const MeshSequence& mesh, PartMembers members);

  const MeshSequence& mesh() const { return *mesh_; }

  size_t vertex_count() const { return members_.vertices.size(); }

  /// As an archive has them: clockwise.
  const std::vector<int32_t>& face_counts() const { return face_counts_; }

  const std::vector<int32_t>& face_indices() const { return face_indices_; }

  /// Numbers in the mesh of the look's vertices, polygons, and corners in the archive's order.
  const PartMembers& members() const { return members_; }

  /// Values of the look's elements, out of those of all of the mesh.
  std::vector<float> of_vertices(std::span<const float> values, size_t components) const;
  std::vector<float> of_corners(std::span<const float> values, size_t components) const;

  /// Faces of a material.
  std::vector<int32_t> faces_of(const std::string& material) const;

 private:
  const MeshSequence* mesh_;
  PartMembers members_;
  std::vector<int32_t> face_counts_, face_indices_;
};

/// The content of an object in a frame.
struct AbcSample {
  std::span<const float> positions;       ///< of the whole mesh
  std::span<const Attribute> attributes;  ///< of the whole mesh, in this frame
  std::span<const float> corner_normals;  ///< of the whole mesh, three for each corner; or none
};

struct AbcMeshOptions {
  bool is_hidden = false;  ///< in some frames
  bool normals = false;
  bool moving = false;  ///< attributes of vertices differ from frame to frame
};

/// Writes an object of the schema PolyMesh, frame by frame.
class PolyMeshOutput {
 public:
  /// An object below `parent`. `looks` are all that it will show.
  PolyMeshOutput(AbcObjectOutput& parent, std::string name, uint32_t sampling,
                 std::vector<AbcLook> looks, const AbcMeshOptions& options);

  const std::vector<AbcLook>& looks() const { return looks_; }

  /// The next frame shows one of the looks.
  void show(size_t look, const AbcSample& sample);

  /// The next frame shows nothing.
  void hide();

 private:
  /// Values beside the positions.
  struct Param {
    AttributeKind kind;
    std::string name;    ///< in the archive
    std::string source;  ///< of the attribute
    bool per_corner;
    uint32_t components;
    bool is_still;  ///< one sample for all frames
    AbcPropertyOutput* values = nullptr;
    AbcPropertyOutput* indices = nullptr;
  };

  AbcPropertyOutput& timed(AbcPropertyOutput& property);
  void add_params(AbcCompoundOutput& geometry, uint32_t sampling, bool moving);
  void create(Param& param, bool in_geometry, AbcCompoundOutput& parent, uint32_t sampling);
  void add_face_sets(AbcObjectOutput& object, uint32_t sampling);
  void write(Param& param, const AbcLook& look, const AbcSample& sample);
  void show_faces(size_t look);

  std::vector<AbcLook> looks_;
  std::vector<AbcPropertyOutput*> timed_;  ///< that get a sample in each frame
  AbcPropertyOutput *bounds_, *positions_, *face_indices_, *face_counts_;
  AbcPropertyOutput *visible_ = nullptr, *normals_ = nullptr;
  std::vector<Param> params_;
  std::map<std::string, AbcPropertyOutput*> face_sets_;  ///< faces by material
  size_t last_look_ = SIZE_MAX;
  uint32_t hidden_at_start_ = 0;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_POLY_MESH_OUTPUT_H_
