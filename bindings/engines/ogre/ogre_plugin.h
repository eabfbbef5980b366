// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_ENGINES_OGRE_OGRE_PLUGIN_H_
#define ANICODEC_SDK_ENGINES_OGRE_OGRE_PLUGIN_H_

#include "bindings/engines/ogre/ogre_entity.h"

#include <memory>

#include <OgrePlugin.h>

namespace anicodec::ogre {

/// Tells OGRE how to make entities of type "Anic". Loaded by name (Plugin_Anicodec), or installed by
/// Root::installPlugin().
class Plugin : public Ogre::Plugin {
 public:
  const Ogre::String& getName() const override;

  void install() override {}

  void initialise() override;
  void shutdown() override;

  void uninstall() override {}

 private:
  std::unique_ptr<EntityFactory> factory_;
};

}  // namespace anicodec::ogre

#endif  // ANICODEC_SDK_ENGINES_OGRE_OGRE_PLUGIN_H_
