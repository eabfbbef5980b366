// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips in a scene of OGRE: several instances at different times, a cross-fade, shadows, a material of motion.
//
//   ogre_scene [--card] [--motion] [--frames N] [--picture FILE.ppm] CLIP.anic...
//   ogre_scene --plugin Plugin_Anicodec.so CLIP.anic
#include "bindings/engines/ogre/ogre_plugin.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <Ogre.h>

namespace {

constexpr unsigned kWidth = 480, kHeight = 270;
constexpr int kNoDisplay = 3;
const char* const kGroup = "General";

constexpr char kLit[] = R"(#version 330 core
uniform mat4 world, worldViewProjection, shadow;
in vec4 vertex;
in vec3 normal;
in vec3 uv7;
out vec3 direction, motion;
out vec4 inShadow;
void main() {
  direction = mat3(world) * normal;
  motion = vertex.xyz - uv7;
  inShadow = shadow * world * vertex;
  gl_Position = worldViewProjection * vertex;
}
)";

constexpr char kLitColour[] = R"(#version 330 core
uniform vec4 diffuse, ambient, lampColour, lamp;
in vec3 direction, motion;
in vec4 inShadow;
out vec4 result;
void main() {
  float light = max(dot(normalize(direction), normalize(lamp.xyz)), 0.0);
  result = vec4(diffuse.rgb * (ambient.rgb + lampColour.rgb * light), 1.0);
}
)";

constexpr char kGroundColour[] = R"(#version 330 core
uniform sampler2D depths;
in vec3 direction, motion;
in vec4 inShadow;
out vec4 result;
void main() {
  vec3 p = inShadow.xyz / inShadow.w;
  float light = 0.0;
  for (int i = 0; i < 9; ++i) {
    vec2 at = p.xy + vec2(i % 3 - 1, i / 3 - 1) / 2048.0;
    light += texture(depths, at).r + 0.002 < p.z * 0.5 + 0.5 ? 0.0 : 1.0 / 9.0;
  }
  result = vec4(vec3(0.75, 0.77, 0.7) * (0.35 + 0.65 * light), 1.0);
}
)";

constexpr char kMotionColour[] = R"(#version 330 core
uniform float size;
in vec3 direction, motion;
in vec4 inShadow;
out vec4 result;
void main() { result = vec4(min(abs(motion) / size * 40.0, vec3(1.0)), 1.0); }
)";

constexpr char kDepth[] = R"(#version 330 core
out vec4 result;
void main() { result = vec4(gl_FragCoord.z); }
)";

Ogre::String program(const Ogre::String& name, Ogre::GpuProgramType type, const char* source) {
  Ogre::HighLevelGpuProgramPtr made =
      Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, kGroup, "glsl", type);
  made->setSource(source);
  return name;
}

Ogre::MaterialPtr material(const Ogre::String& name, const Ogre::String& fragment) {
  using Parameters = Ogre::GpuProgramParameters;
  Ogre::MaterialPtr made = Ogre::MaterialManager::getSingleton().create(name, kGroup);
  Ogre::Pass* pass = made->getTechnique(0)->getPass(0);
  pass->setVertexProgram("Scene/Vertex");
  pass->setFragmentProgram(fragment);
  Ogre::GpuProgramParametersSharedPtr parameters = pass->getVertexProgramParameters();
  parameters->setIgnoreMissingParams(true);
  parameters->setNamedAutoConstant("world", Parameters::ACT_WORLD_MATRIX);
  parameters->setNamedAutoConstant("worldViewProjection", Parameters::ACT_WORLDVIEWPROJ_MATRIX);
  parameters->setNamedAutoConstant("shadow", Parameters::ACT_TEXTURE_VIEWPROJ_MATRIX, 0);
  parameters = pass->getFragmentProgramParameters();
  parameters->setIgnoreMissingParams(true);
  parameters->setNamedAutoConstant("diffuse", Parameters::ACT_SURFACE_DIFFUSE_COLOUR);
  parameters->setNamedAutoConstant("ambient", Parameters::ACT_AMBIENT_LIGHT_COLOUR);
  parameters->setNamedAutoConstant("lampColour", Parameters::ACT_LIGHT_DIFFUSE_COLOUR, 0);
  parameters->setNamedAutoConstant("lamp", Parameters::ACT_LIGHT_POSITION, 0);
  return made;
}

void make_materials() {
  program("Scene/Vertex", Ogre::GPT_VERTEX_PROGRAM, kLit);
  const auto fragment = [](const char* name, const char* source) {
    return program(name, Ogre::GPT_FRAGMENT_PROGRAM, source);
  };
  material("Scene/Depth", fragment("Scene/DepthColour", kDepth));
  material("Scene/Motion", fragment("Scene/MotionColour", kMotionColour));
  const Ogre::String lit = fragment("Scene/LitColour", kLitColour);
  for (int i = 0; i < 3; ++i) {
    const Ogre::ColourValue colours[] = {Ogre::ColourValue(0.9F, 0.5F, 0.4F),
                                         Ogre::ColourValue(0.4F, 0.6F, 0.9F),
                                         Ogre::ColourValue(0.5F, 0.8F, 0.4F)};
    material("Scene/Lit" + Ogre::StringConverter::toString(i), lit)->setDiffuse(colours[i]);
  }
  Ogre::Pass* ground = material("Scene/Ground", fragment("Scene/GroundColour", kGroundColour))
                           ->getTechnique(0)
                           ->getPass(0);
  Ogre::TextureUnitState* depths = ground->createTextureUnitState();
  depths->setContentType(Ogre::TextureUnitState::CONTENT_SHADOW);
  depths->setTextureFiltering(Ogre::TFO_NONE);
  depths->setTextureAddressingMode(Ogre::TextureUnitState::TAM_BORDER);
  depths->setTextureBorderColour(Ogre::ColourValue::White);
  ground->getFragmentProgramParameters()->setNamedConstant("depths", 0);
}

void make_ground(Ogre::SceneManager* scene) {
  Ogre::MeshManager::getSingleton().createPlane("Scene/Plane", kGroup,
                                                Ogre::Plane(Ogre::Vector3::UNIT_Y, 0), 30, 30, 1, 1,
                                                true, 1, 1, 1, Ogre::Vector3::UNIT_Z);
  Ogre::Entity* ground = scene->createEntity("Scene/Plane");
  ground->setMaterialName("Scene/Ground");
  ground->setCastShadows(false);
  scene->getRootSceneNode()->createChildSceneNode()->attachObject(ground);
}

struct Options {
  bool card = false, motion = false;
  int frames = 30;
  std::string picture, plugin;
  std::vector<std::string> files;
};

bool read(int argc, char** argv, Options* out) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--card")
      out->card = true;
    else if (word == "--motion")
      out->motion = true;
    else if (word == "--frames" && i + 1 < argc)
      out->frames = std::atoi(argv[++i]);
    else if (word == "--plugin" && i + 1 < argc)
      out->plugin = argv[++i];
    else if (word == "--picture" && i + 1 < argc)
      out->picture = argv[++i];
    else if (word.rfind("--", 0) == 0)
      return false;
    else
      out->files.push_back(word);
  }
  return !out->files.empty();
}

/// A file's folder becomes a place where resources are found; its name there.
std::string resource(const std::string& path) {
  const size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash);
  auto& groups = Ogre::ResourceGroupManager::getSingleton();
  if (!groups.resourceLocationExists(folder, kGroup))
    groups.addResourceLocation(folder, "FileSystem", kGroup);
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// A program that does not link the plug-in: it loads it by name, and knows entities as movable objects alone.
void load_plugin(Ogre::Root* root, const Options& options) {
  root->loadPlugin(options.plugin);
  Ogre::SceneManager* scene = root->createSceneManager();
  const Ogre::NameValuePairList parameters = {{"file", resource(options.files[0])},
                                              {"group", kGroup}};
  Ogre::MovableObject* object = scene->createMovableObject("clip", "Anic", &parameters);
  std::printf("%s of radius %g\n", object->getMovableType().c_str(),
              static_cast<double>(object->getBoundingRadius()));
  scene->destroyAllMovableObjects();
  root->destroySceneManager(scene);
  root->unloadPlugin(options.plugin);
}

/// Loads the renderer and makes a window that nobody sees; null without a display.
Ogre::RenderWindow* make_window(Ogre::Root* root) {
  root->loadPlugin(ANICODEC_OGRE_PLUGINS "/RenderSystem_GL3Plus");
  root->setRenderSystem(root->getAvailableRenderers().front());
  root->initialise(false);
  const Ogre::NameValuePairList hidden = {{"hidden", "true"}};
  return root->createRenderWindow("clips", kWidth, kHeight, false, &hidden);
}

void save(Ogre::RenderTarget* target, const std::string& path) {
  std::vector<unsigned char> pixels(size_t{3} * kWidth * kHeight);
  target->copyContentsToMemory(Ogre::Box(0, 0, kWidth, kHeight),
                               Ogre::PixelBox(kWidth, kHeight, 1, Ogre::PF_BYTE_RGB, pixels.data()),
                               Ogre::RenderTarget::FB_AUTO);
  FILE* file = std::fopen(path.c_str(), "wb");
  if (!file)
    OGRE_EXCEPT(Ogre::Exception::ERR_CANNOT_WRITE_TO_FILE, path, "ogre_scene");
  std::fprintf(file, "P6\n%u %u\n255\n", kWidth, kHeight);
  std::fwrite(pixels.data(), 1, pixels.size(), file);
  std::fclose(file);
}

int run(const Options& options, Ogre::Root* root) {
  Ogre::RenderWindow* window = nullptr;
  try {
    window = make_window(root);
  } catch (const Ogre::Exception& e) {
    std::fprintf(stderr, "ogre_scene: nothing draws here: %s\n", e.getDescription().c_str());
    return kNoDisplay;
  }
  auto& groups = Ogre::ResourceGroupManager::getSingleton();
  groups.addResourceLocation(ANICODEC_OGRE_MEDIA "/ShadowVolume", "FileSystem", "OgreInternal");
  groups.initialiseAllResourceGroups();
  if (!options.plugin.empty()) {
    load_plugin(root, options);
    return 0;
  }
  anicodec::ogre::Plugin plugin;
  root->installPlugin(&plugin);
  make_materials();
  Ogre::SceneManager* scene = root->createSceneManager();
  scene->setAmbientLight(Ogre::ColourValue(0.3F, 0.3F, 0.3F));
  scene->setShadowTechnique(Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED);
  scene->setShadowTextureSettings(2048, 1, Ogre::PF_FLOAT32_R);
  scene->setShadowTextureCasterMaterial(
      Ogre::MaterialManager::getSingleton().getByName("Scene/Depth", kGroup));
  scene->setShadowFarDistance(16);
  scene->setShadowDirectionalLightExtrusionDistance(30);
  Ogre::Light* sun = scene->createLight();
  sun->setType(Ogre::Light::LT_DIRECTIONAL);
  sun->setShadowNearClipDistance(0.1F);
  sun->setShadowFarClipDistance(60);
  sun->setDiffuseColour(0.8F, 0.8F, 0.8F);
  Ogre::SceneNode* sky = scene->getRootSceneNode()->createChildSceneNode();
  sky->setDirection(Ogre::Vector3(-0.5F, -1, -0.4F).normalisedCopy());
  sky->attachObject(sun);
  make_ground(scene);

  std::vector<anicodec::ogre::Entity*> entities;
  for (int i = 0; i < 9; ++i) {
    const std::string file = resource(options.files[static_cast<size_t>(i) % options.files.size()]);
    const Ogre::NameValuePairList parameters = {
        {"file", file}, {"group", kGroup}, {"path", options.card ? "card" : "cpu"}};
    auto* entity = static_cast<anicodec::ogre::Entity*>(scene->createMovableObject(
        "clip " + std::to_string(i), anicodec::ogre::EntityFactory::kType, &parameters));
    const Ogre::String look = options.motion ? "Scene/Motion" : "Scene/Lit" + std::to_string(i % 3);
    entity->set_material(Ogre::MaterialManager::getSingleton().getByName(look, kGroup));
    entity->keep_previous(options.motion);
    if (options.motion) {
      entity->set_wrap(ANIC_WRAP_PING_PONG);
      const auto size = static_cast<Ogre::Real>(entity->getBoundingBox().getSize().length());
      Ogre::MaterialManager::getSingleton()
          .getByName(look, kGroup)
          ->getTechnique(0)
          ->getPass(0)
          ->getFragmentProgramParameters()
          ->setNamedConstant("size", size);
    }
    entity->set_time(0.11 * i);
    if (i == 4)
      entity->cross_fade("", 1);  // into its own beginning
    Ogre::SceneNode* node = scene->getRootSceneNode()->createChildSceneNode();
    const Ogre::AxisAlignedBox box = entity->getBoundingBox();
    const Ogre::Real scale = 2 / box.getSize().length();
    node->attachObject(entity);
    node->setScale(Ogre::Vector3(scale));
    const Ogre::Vector3 centre = box.getCenter();
    node->setPosition(Ogre::Vector3(2.4F * static_cast<Ogre::Real>(i % 3 - 1) - scale * centre.x,
                                    -scale * box.getMinimum().y,
                                    -2.4F * static_cast<Ogre::Real>(i / 3) - scale * centre.z));
    entities.push_back(entity);
  }

  Ogre::Camera* camera = scene->createCamera("camera");
  camera->setNearClipDistance(0.1F);
  camera->setFarClipDistance(100);
  camera->setAspectRatio(static_cast<Ogre::Real>(kWidth) / kHeight);
  Ogre::SceneNode* eye =
      scene->getRootSceneNode()->createChildSceneNode(Ogre::Vector3(1.5F, 4, 5.5F));
  eye->attachObject(camera);
  eye->lookAt(Ogre::Vector3(0, 0.4F, -2), Ogre::Node::TS_WORLD);
  window->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.6F, 0.75F, 0.9F));

  double computing = 0;
  for (int f = 0; f < options.frames; ++f) {
    const auto begin = std::chrono::steady_clock::now();
    for (anicodec::ogre::Entity* entity : entities)
      entity->add_time(1 / 60.0);
    root->renderOneFrame();
    computing += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  size_t on_card = 0, vertices = 0;
  for (anicodec::ogre::Entity* entity : entities) {
    on_card += entity->is_on_card() ? 1 : 0;
    vertices += entity->asset().mesh(0).vertex_count;
  }
  std::printf("%zu entities, %zu on the card, %zu vertices: %.2f ms a frame\n", entities.size(),
              on_card, vertices, 1000 * computing / options.frames);
  if (!options.picture.empty())
    save(window, options.picture);
  scene->destroyAllMovableObjects();
  root->destroySceneManager(scene);
  root->uninstallPlugin(&plugin);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!read(argc, argv, &options)) {
    std::fprintf(
        stderr,
        "usage: ogre_scene [--card] [--motion] [--frames N] [--picture FILE.ppm] CLIP.anic...\n"
        "       ogre_scene --plugin Plugin_Anicodec.so CLIP.anic\n");
    return 1;
  }
  Ogre::LogManager logs;
  logs.createLog("ogre_scene", true, false, true);
  logs.setLogDetail(Ogre::LL_LOW);
  Ogre::Root root("", "", "");
  try {
    return run(options, &root);
  } catch (const Ogre::Exception& e) {
    std::fprintf(stderr, "ogre_scene: %s\n", e.getFullDescription().c_str());
    return 1;
  }
}
