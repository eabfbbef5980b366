// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_TEXTURES_TEXEL_MESH_H_
#define ANICODEC_TOOLS_TEXTURES_TEXEL_MESH_H_

#include "codec/sequence/frame_normals.h"
#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/glb_vertices.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace anicodec::tools {

/// The place of a vertex in a texture, from 0 to 1, v from the top.
using TexelPlace = std::pair<double, double>;

/// The surface of a clip with a texel for each vertex: corners at one vertex that differ in texture coordinates, colours
/// or normals have one each. All of it is one object.
class TexelMesh {
 public:
  /// Counts, polygons and the first frame's attributes of a clip whose y points up and whose unit is a metre.
  explicit TexelMesh(MeshSequence clip);

  TexelMesh(const TexelMesh&) = delete;
  TexelMesh& operator=(const TexelMesh&) = delete;

  uint32_t vertex_count() const { return static_cast<uint32_t>(vertices_->corners().size()); }

  const MeshSequence& clip() const { return clip_; }

  /// False for points, which have none.
  bool has_normals() const { return clip_.polygons.size() > 0; }

  /// Positions of a frame, three numbers a texel, from those of the clip's vertices.
  std::vector<float> positions(std::span<const float> frame) const {
    return vertices_->of_vertices(frame, 3);
  }

  /// Unit normals of a frame; the hard edges are the clip's, none where it knows none.
  std::vector<float> normals(std::span<const float> frame) const;

  /// A GLB of the surface at rest: TEXCOORD_1 is the place of each vertex' texel, TEXCOORD_0 the clip's own texture
  /// coordinates, or zeros; normals, colours and materials come along. `rest`: positions of the clip's vertices.
  std::string glb(std::span<const float> rest, const std::vector<TexelPlace>& places) const;

 private:
  MeshSequence clip_;
  std::optional<GlbVertices> vertices_;
  std::optional<FrameNormals> normals_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_TEXTURES_TEXEL_MESH_H_
