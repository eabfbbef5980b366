// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_ENGINES_OGRE_OGRE_ENTITY_H_
#define ANICODEC_SDK_ENGINES_OGRE_OGRE_ENTITY_H_

#include "bindings/engines/ogre/ogre_clip.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <OgreAxisAlignedBox.h>
#include <OgreMovableObject.h>

namespace anicodec::ogre {

class EntitySection;

/// A clip in a scene. Only entities that are drawn are computed: seeking and filling happen when the scene manager has
/// found one in view. y is up whatever the clip says.
class Entity : public Ogre::MovableObject {
 public:
  enum class Path : uint8_t {
    kCpu,   ///< positions and smooth normals in vertex buffers, for any material
    kCard,  ///< a vertex shader combines the basis; facets. If it cannot, the CPU does
  };

  Entity(const Ogre::String& name, std::shared_ptr<Clip> clip, Path path);
  ~Entity() override;

  const anic::Asset& asset() const { return clip_->asset(); }

  /// Chooses the clip of the file that is played, at its beginning. Throws Ogre::Exception for names that are none.
  void set_clip(const Ogre::String& name);

  /// Seconds in the clip. A cut: motion begins anew.
  void set_time(double seconds);

  double time() const { return time_; }

  /// Goes on by so many seconds, backwards too; a cross-fade goes on as well.
  void add_time(double seconds);

  /// A node that add_time() moves by the motion of the whole, along the ground and about the vertical, from where
  /// it stands on; of a cross-fade, by that of both clips. It must outlive the entity, whose file was opened in place; null: none.
  void set_root(Ogre::SceneNode* node) { root_ = node; }

  /// Fades to the beginning of another clip of the file, or of the same.
  void cross_fade(const Ogre::String& name, double seconds);

  bool is_fading() const { return fade_length_ > 0; }

  void set_wrap(anic_wrap wrap) { wrap_ = wrap; }

  /// Share of the components to play, in (0, 1].
  void set_quality(double quality);

  /// For all groups of triangles; without it, those that the file names, where there are such. The
  /// card's path takes the diffuse colour of the material's first pass.
  void set_material(const Ogre::MaterialPtr& material);

  /// On the CPU, positions of the frame drawn before go to texture coordinates 7, for motion blur.
  void keep_previous(bool wanted);

  /// Whether the last drawing was the card's, in all meshes.
  bool is_on_card() const;

  /// Positions of the render vertices of a mesh as the CPU filled them last; for tools and tests.
  const std::vector<float>& positions(size_t mesh) const;

  const Ogre::String& getMovableType() const override;

  const Ogre::AxisAlignedBox& getBoundingBox() const override { return box_; }

  Ogre::Real getBoundingRadius() const override { return radius_; }

  void _updateRenderQueue(Ogre::RenderQueue* queue) override;
  void visitRenderables(Ogre::Renderable::Visitor* visitor, bool debug) override;

 private:
  friend class EntitySection;
  void move_root(double seconds);
  void show();
  void fill(size_t mesh);
  bool fill_row(size_t mesh);
  void fill_buffers(size_t mesh);

  std::shared_ptr<Clip> clip_;
  anic::Context context_;
  Ogre::SceneNode* root_ = nullptr;
  Path path_;
  uint32_t row_ = 0;
  uint32_t generation_ = 0;
  std::vector<std::unique_ptr<EntitySection>> sections_;
  std::vector<float> texels_;
  Ogre::AxisAlignedBox box_;
  Ogre::Real radius_ = 0;
  anic_wrap wrap_ = ANIC_WRAP_LOOP;
  uint32_t playing_ = 0, fading_ = 0;
  double time_ = 0, fade_time_ = 0, fade_done_ = 0, fade_length_ = 0;
  bool stale_ = true, cut_ = true, previous_ = false, z_up_ = false;
  unsigned long drawn_ = 0;  ///< number of the frame
};

/// Makes entities: createMovableObject(name, "Anic", {{"file", ...}, {"group", ...}, {"path", "cpu" or "card"},
/// {"in_place", "true"}}).
class EntityFactory : public Ogre::MovableObjectFactory {
 public:
  static const Ogre::String kType;

  const Ogre::String& getType() const override { return kType; }

 protected:
  Ogre::MovableObject* createInstanceImpl(const Ogre::String& name,
                                          const Ogre::NameValuePairList* parameters) override;
};

}  // namespace anicodec::ogre

#endif  // ANICODEC_SDK_ENGINES_OGRE_OGRE_ENTITY_H_
