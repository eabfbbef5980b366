// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// For this room alone: it shows ufbx.
#ifndef ANICODEC_TOOLS_IO_FBX_FBX_TAKE_H_
#define ANICODEC_TOOLS_IO_FBX_FBX_TAKE_H_

#include "tools/io/fbx/fbx_message.h"
#include "tools/io/fbx/fbx_scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// Whether curves of an animation change anything, or a cache moves a mesh.
bool may_move(const FbxScene& scene, const ufbx_anim& anim);

/// The meshes of a scene as one, moved by an animation; without one, as they are at rest.
class FbxTake {
 public:
  /// Whether some frame shows the mesh of a node while it mirrors, or while it does not.
  struct Facings {
    bool plain = false, mirrored = false;
  };

  /// Finds the frames, and the meshes that they show. Throws Error(kInput).
  FbxTake(const FbxScene& scene, const ufbx_anim* anim, const GltfOptions& options,
          const FbxNote& note);

  /// Adds what this take shows to what others do; `facings` has one for each node of the scene.
  void add_facings(std::vector<Facings>* facings) const;

  /// Adds all as a clip, with the meshes that this take or others show. Throws Error(kInput) where positions take more memory than is allowed or are not finite.
  void bake(const std::string& name, const std::vector<Facings>& facings, FbxMessage& message);

 private:
  enum class State : uint8_t { kHidden, kPlain, kMirrored };

  /// A mesh that stands at a node, while the node mirrors or while it does not.
  struct Piece {
    size_t node = 0;  ///< among those of the scene
    bool mirrored = false;
    std::string name;
    uint32_t first_vertex = 0;
    std::vector<uint32_t> order;  ///< corners of the mesh in the order of the clip
  };

  void set_timing();
  std::vector<double> key_times() const;
  double time_of(uint32_t frame) const;
  void watch();
  void add_pieces(const std::vector<Facings>& facings);
  MeshSequence describe(Piece& piece, const ufbx_scene& scene) const;
  void add_attributes(const Piece& piece, const ufbx_scene& scene, MeshSequence& out) const;
  void move(const Piece& piece, const ufbx_scene& scene, uint32_t frame, float* out) const;

  const FbxScene& scene_;
  const ufbx_anim* anim_;
  const GltfOptions& options_;
  const FbxNote& note_;
  FrameRate rate_;
  double begin_ = 0, end_ = 0;
  uint32_t frames_ = 1;
  std::vector<std::vector<State>> states_;  ///< of each node, of each frame
  std::vector<Piece> pieces_;
  MeshSequence still_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FBX_FBX_TAKE_H_
