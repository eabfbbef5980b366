// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_BAKE_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_BAKE_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/gltf.h"
#include "tools/io/gltf/gltf_animation.h"
#include "tools/io/gltf/gltf_geometry.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace anicodec::tools {

/// A primitive of the scene among what is baked.
struct GltfBaked {
  uint32_t node = 0, mesh = 0;
  size_t primitive = 0;
  const GltfGeometry* geometry = nullptr;  ///< as in the document; of the bake
  uint32_t first_vertex = 0;               ///< of its vertices among all
  bool turned = false;                     ///< the faces are turned over
  bool owns_vertices = true;               ///< false: those of an earlier primitive of the node
};

/// The meshes of a document's scene as one, moved by an animation.
class GltfBake {
 public:
  /// Takes the meshes of the scene, or those where mesh or node has the name that is asked for, but
  /// for hidden ones that no animation shows. The document must outlive it. Throws Error(kUsage)
  /// when there is none of that name, Error(kInput) for faults of the geometry.
  GltfBake(const GltfDocument& document, const GltfOptions& options);
  GltfBake(const GltfBake&) = delete;
  GltfBake& operator=(const GltfBake&) = delete;
  ~GltfBake();

  /// All but positions and normals.
  MeshSequence still() const;

  /// The primitives, those of a node one after the other.
  std::vector<GltfBaked> primitives() const;

  /// Nodes whose transforms or weights move a vertex.
  std::vector<bool> moving_nodes() const;

  /// Which of `ticks` frames at a rate from the first key on a clip needs: all but those between keys that
  /// are more than ten seconds apart where all moves in straight lines at even speed, within 1e-5 of the
  /// size. Cost: O(frames needed x log(ticks) x vertices).
  std::vector<uint32_t> needed_ticks(const GltfClip& clip, uint32_t ticks, double rate) const;

  /// Adds the positions, and texture coordinates and colours that targets change, of the frames that stand
  /// at ticks of the rate of `out` from the first key of the clip (without one: of the pose at rest), and
  /// normals and tangents of the first; hard edges where a primitive has no normals. While a node is
  /// hidden its vertices are at one point. Throws Error(kInput) when they take more memory than is
  /// allowed or are not finite.
  void add_frames(const GltfClip* clip, const std::vector<uint32_t>& ticks,
                  const GltfOptions& options, MeshSequence& out) const;

 private:
  struct Piece;
  struct Worlds;

  std::shared_ptr<const GltfGeometry> geometry_of(uint32_t mesh, size_t primitive);
  void take_memory(uint64_t bytes, const std::string& path);
  void add_node(uint32_t node);
  void name_parts();
  uint64_t add_pieces(const Piece& like);
  bool is_skinned(const Piece& piece) const;
  Worlds worlds_of(const GltfPose& pose) const;
  void move(const Piece& piece, const GltfPose& pose, const Worlds& worlds, float* positions) const;
  void move_attributes(uint32_t frames, const std::function<GltfPose(uint32_t)>& pose_of,
                       uint64_t memory_left, MeshSequence& out) const;
  std::vector<float> positions_in(const GltfPose& pose) const;
  void add_hard_edges(MeshSequence& out) const;
  void add_normals(const GltfPose& pose, const Worlds& worlds, MeshSequence& out) const;

  const GltfDocument& document_;
  const GltfOptions& options_;
  uint64_t memory_left_;
  std::map<std::pair<uint32_t, size_t>, std::shared_ptr<const GltfGeometry>> geometries_;
  std::vector<uint32_t> order_;  ///< nodes, parents first
  std::vector<Piece> pieces_;
  std::vector<std::vector<float>> inverse_binds_;  ///< of each skin, joints x 16
  PolygonLabels parts_;
  std::vector<uint32_t> node_of_part_;
  uint64_t vertex_count_ = 0;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_BAKE_H_
