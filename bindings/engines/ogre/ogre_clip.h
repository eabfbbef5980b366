// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_ENGINES_OGRE_OGRE_CLIP_H_
#define ANICODEC_SDK_ENGINES_OGRE_OGRE_CLIP_H_

#include <anicodec/anicodec.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <OgreHardwareIndexBuffer.h>
#include <OgreHardwareVertexBuffer.h>
#include <OgreMaterial.h>
#include <OgreString.h>
#include <OgreTexture.h>

namespace anicodec::ogre {

/// A mesh of a file: what all entities share of it.
struct ClipMesh {
  anic::RenderPlan plan;
  anic_render_info info = {};
  /// For each group, the colour that the file gives its material, else white.
  std::vector<Ogre::ColourValue> colours;
  std::vector<Ogre::String> materials;  ///< of each group; may be empty
  Ogre::HardwareIndexBufferSharedPtr indices;
  Ogre::HardwareVertexBufferSharedPtr uvs;  ///< two floats of uv, and the vertex of the file

  /// For the graphics card. Segments lie below one another; first[s] is the row of segment s in the
  /// textures of anic_texture.
  std::array<Ogre::TexturePtr, 3> textures;
  std::vector<std::array<uint32_t, 3>> first;
  std::vector<uint8_t> has_pose;
  uint32_t width = 0, rows = 0;
  uint32_t state_texels = 0;  ///< of an instance's row; 0: the card cannot play it
  Ogre::MaterialPtr material;
};

/// A file, opened once for all entities of it. Made and destroyed on the thread that renders.
class Clip {
 public:
  /// Opens a resource; `in_place`: without the motion of the whole. Throws Ogre::Exception when there is
  /// none or it is damaged.
  Clip(const Ogre::String& file, const Ogre::String& group, bool in_place);
  ~Clip();

  const anic::Asset& asset() const { return asset_; }

  size_t mesh_count() const { return meshes_.size(); }

  const ClipMesh& mesh(size_t i) const { return meshes_[i]; }

  /// A number of a clip by its name; 0 for the empty name. Throws Ogre::Exception for others.
  uint32_t find(const Ogre::String& name) const;

  /// Makes the textures and the material for the graphics card, if they are not there yet.
  void prepare_card();

  /// A row of the textures of states for an instance; rows are given back.
  uint32_t take_row();
  void give_row(uint32_t row);

  /// Changes when rows have to be uploaded anew, as the textures have become larger.
  uint32_t generation() const { return row_count_; }

  /// Uploads a row: `count` texels.
  void upload_row(size_t mesh, uint32_t row, float* texels, uint32_t count);

 private:
  void make_mesh(uint32_t index);
  void make_textures(uint32_t index);
  void make_states(size_t mesh, uint32_t count);

  Ogre::String name_;
  anic::Asset asset_;
  std::vector<ClipMesh> meshes_;
  std::vector<Ogre::TexturePtr> states_;  ///< by mesh
  std::vector<uint32_t> free_rows_;
  uint32_t row_count_ = 0;
  bool on_card_ = false;
};

/// A white material for the vertex buffers of the CPU, with shaders, which some renderers do not go without.
Ogre::MaterialPtr plain_material();

/// The clip of a resource, with the motion of the whole or without; entities share it while any of them
/// is there.
std::shared_ptr<Clip> shared_clip(const Ogre::String& file, const Ogre::String& group,
                                  bool in_place);

}  // namespace anicodec::ogre

#endif  // ANICODEC_SDK_ENGINES_OGRE_OGRE_CLIP_H_
