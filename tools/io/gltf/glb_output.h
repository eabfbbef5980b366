// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLB_OUTPUT_H_
#define ANICODEC_TOOLS_IO_GLTF_GLB_OUTPUT_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/gltf_material.h"

#include <memory>
#include <span>
#include <string>

namespace anicodec::tools {

/// Makes a GLB of a clip, frame by frame: a node with a mesh for each part, together below a node.
/// A mesh is that of the first frame; each frame is a morph target, stored sparsely where that is
/// smaller, and an animation gives each its turn at its time, of several clips one for each. A single frame has
/// none. Polygons become triangles by the first frame (corner_triangles()), a primitive for each
/// material; vertices whose corners differ in UV, colours, hard edges or parts come once for each. Clips whose up axis is Z are turned, and units
/// scaled, by the topmost node. Normals of every frame come along
/// where the clip knows its hard edges (none where all are hard and all polygons triangles), and colours and texture coordinates of every frame where
/// they change. Positions read back within a rounding of float32.
class GlbOutput {
 public:
  /// `step`: each frame stands until the next, instead of moving to it. `images`: those that materials
  /// name by "#name", to be put inside. Takes counts, polygons,
  /// attributes and timing from `clip`, which must outlive it; not its positions. `attributes`: in all
  /// frames, where they move and the clip has those of the first frame alone; else null.
  GlbOutput(const MeshSequence& clip, bool step, std::span<const GltfImage> images = {},
            const std::vector<Attribute>* attributes = nullptr);
  GlbOutput(const GlbOutput&) = delete;
  GlbOutput& operator=(const GlbOutput&) = delete;
  ~GlbOutput();

  /// The frames in order, vertices x 3 each, with attributes of the frame in the form of those of
  /// the clip.
  void add_frame(std::span<const float> positions, std::span<const Attribute> attributes);

  /// The bytes of the file, after the last frame. `times`: seconds of each frame; where the first
  /// is negative, all are moved to start at 0. Throws Error(kInput) beyond 4 GiB, the most a GLB
  /// can be.
  std::string finish(std::span<const float> times);

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLB_OUTPUT_H_
