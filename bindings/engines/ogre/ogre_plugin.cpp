// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/engines/ogre/ogre_plugin.h"

#include <Ogre.h>

namespace anicodec::ogre {

const Ogre::String& Plugin::getName() const {
  static const Ogre::String name = "anicodec";
  return name;
}

void Plugin::initialise() {
  factory_ = std::make_unique<EntityFactory>();
  Ogre::Root::getSingleton().addMovableObjectFactory(factory_.get());
}

void Plugin::shutdown() {
  Ogre::Root::getSingleton().removeMovableObjectFactory(factory_.get());
  factory_.reset();
}

namespace {

std::unique_ptr<Plugin> plugin;

}  // namespace

}  // namespace anicodec::ogre

extern "C" {

// Called by Root::loadPlugin() and Root::unloadPlugin().
__attribute__((visibility("default"))) void dllStartPlugin() {
  anicodec::ogre::plugin = std::make_unique<anicodec::ogre::Plugin>();
  Ogre::Root::getSingleton().installPlugin(anicodec::ogre::plugin.get());
}

__attribute__((visibility("default"))) void dllStopPlugin() {
  Ogre::Root::getSingleton().uninstallPlugin(anicodec::ogre::plugin.get());
  anicodec::ogre::plugin.reset();
}
}
