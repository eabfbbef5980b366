// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/engines/ogre/ogre_entity.h"

#include "bindings/engines/ogre/ogre_plugin.h"
#include "build_paths.h"

#include <memory>
#include <string>
#include <vector>

#include <Ogre.h>
#include <gtest/gtest.h>

namespace anicodec::ogre {
namespace {

/// OGRE with a window that nobody sees and a camera that looks along -z from (0, 0, 10).
class OgreEntity : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    logs_ = std::make_unique<Ogre::LogManager>();
    logs_->createLog("ogre_entity_test", true, false, true);
    root_ = std::make_unique<Ogre::Root>("", "", "");
    root_->loadPlugin(ANICODEC_OGRE_PLUGINS "/RenderSystem_GL3Plus");
    root_->setRenderSystem(root_->getAvailableRenderers().front());
    root_->initialise(false);
    const Ogre::NameValuePairList hidden = {{"hidden", "true"}};
    window_ = root_->createRenderWindow("test", 64, 64, false, &hidden);
    plugin_ = std::make_unique<Plugin>();
    root_->installPlugin(plugin_.get());
    auto& groups = Ogre::ResourceGroupManager::getSingleton();
    groups.addResourceLocation(ANICODEC_OGRE_MEDIA "/ShadowVolume", "FileSystem", "OgreInternal");
    groups.addResourceLocation(ANICODEC_SOURCE_DIR "/tests/conformance", "FileSystem", "General");
    groups.initialiseAllResourceGroups();
  }

  static void TearDownTestSuite() {
    root_->uninstallPlugin(plugin_.get());
    plugin_.reset();
    root_.reset();
    logs_.reset();
  }

  void SetUp() override {
    scene_ = root_->createSceneManager();
    Ogre::Camera* camera = scene_->createCamera("camera");
    camera->setNearClipDistance(0.1F);
    scene_->getRootSceneNode()->createChildSceneNode(Ogre::Vector3(0, 0, 10))->attachObject(camera);
    window_->addViewport(camera);
  }

  void TearDown() override {
    window_->removeAllViewports();
    scene_->destroyAllMovableObjects();
    root_->destroySceneManager(scene_);
  }

  /// An entity two units wide at a place.
  Entity* make(const std::string& file, const char* path, Ogre::Vector3 at = Ogre::Vector3::ZERO,
               const char* in_place = "false") {
    const Ogre::NameValuePairList parameters = {
        {"file", file + ".anic"}, {"path", path}, {"in_place", in_place}};
    auto* entity = static_cast<Entity*>(
        scene_->createMovableObject(std::to_string(count_++), EntityFactory::kType, &parameters));
    Ogre::SceneNode* node = scene_->getRootSceneNode()->createChildSceneNode(at);
    node->attachObject(entity);
    node->setScale(Ogre::Vector3(2 / entity->getBoundingBox().getSize().length()));
    node->setPosition(at - node->getScale() * entity->getBoundingBox().getCenter());
    return entity;
  }

  static void draw() { ASSERT_TRUE(root_->renderOneFrame()); }

  static std::unique_ptr<Ogre::LogManager> logs_;
  static std::unique_ptr<Ogre::Root> root_;
  static std::unique_ptr<Plugin> plugin_;
  static Ogre::RenderWindow* window_;
  Ogre::SceneManager* scene_ = nullptr;
  int count_ = 0;
};

std::unique_ptr<Ogre::LogManager> OgreEntity::logs_;
std::unique_ptr<Ogre::Root> OgreEntity::root_;
std::unique_ptr<Plugin> OgreEntity::plugin_;
Ogre::RenderWindow* OgreEntity::window_ = nullptr;

/// Positions as the library writes them for what a context shows.
std::vector<float> expected(const anic::Asset& asset, const anic::Context& context) {
  anic_render_plan_options options = ANIC_INIT(anic_render_plan_options);
  options.source_edges = 1;
  options.crease_angle = 60;
  anic::RenderPlan plan;
  EXPECT_TRUE(plan.create(asset, &options));
  std::vector<float> points(size_t{3} * plan.info().vertex_count);
  EXPECT_TRUE(plan.write_positions(context, anic::output(points), 0, plan.info().vertex_count));
  return points;
}

TEST_F(OgreEntity, FillsBuffersWithWhatTheLibraryShows) {
  Entity* entity = make("weights_in_time", "cpu");
  anic::Context context;
  ASSERT_TRUE(context.create(entity->asset()));
  entity->set_clip("");
  entity->set_time(0.31);
  draw();
  ASSERT_TRUE(context.seek(0.31, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP));
  EXPECT_EQ(entity->positions(0), expected(entity->asset(), context));
  EXPECT_FALSE(entity->is_on_card());

  entity->cross_fade("", 1);
  entity->add_time(0.25);
  draw();
  ASSERT_TRUE(context.seek(0.56, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP));
  ASSERT_TRUE(context.blend(0, 0.25, 0.25, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP));
  EXPECT_EQ(entity->positions(0), expected(entity->asset(), context));
  entity->add_time(0.75);
  EXPECT_FALSE(entity->is_fading());
  EXPECT_DOUBLE_EQ(entity->time(), 1.0);

  entity->set_quality(0.3);
  draw();
  ASSERT_TRUE(context.set_quality(0.3));
  ASSERT_TRUE(context.seek(1, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP));
  EXPECT_EQ(entity->positions(0), expected(entity->asset(), context));
}

TEST_F(OgreEntity, ComputesNothingOutOfSight) {
  Entity* seen = make("limb_default", "cpu");
  Entity* behind = make("limb_default", "cpu", Ogre::Vector3(0, 0, 40));
  draw();
  EXPECT_FALSE(seen->positions(0).empty());
  EXPECT_TRUE(behind->positions(0).empty());
  EXPECT_EQ(&seen->asset(), &behind->asset()) << "one file, opened once";
}

TEST_F(OgreEntity, PlaysOnTheCardWhatTheCardCan) {
  Entity* limb = make("limb_small", "card");
  Entity* corrected = make("quad_box_corrected", "card");
  Entity* interpolated = make("nonmanifold_interpolated", "card");
  for (Entity* entity : {limb, corrected, interpolated})
    entity->set_time(0);  // a whole frame, with its corrections
  draw();
  EXPECT_TRUE(limb->is_on_card());
  EXPECT_TRUE(limb->positions(0).empty());
  EXPECT_FALSE(corrected->is_on_card());
  EXPECT_FALSE(interpolated->is_on_card());
  corrected->add_time(0.013);  // between frames there are none
  draw();
  EXPECT_TRUE(corrected->is_on_card());
}

TEST_F(OgreEntity, MakesRoomForManyOnTheCard) {
  std::vector<Entity*> many;
  many.reserve(150);
  for (int i = 0; i < 150; ++i) {
    many.push_back(make("limb_small", "card"));
    if (i % 50 == 0)
      draw();
  }
  draw();
  for (const Entity* entity : many)
    EXPECT_TRUE(entity->is_on_card());
}

TEST_F(OgreEntity, MovesItsRoot) {
  Entity* whole = make("walk", "cpu");
  Entity* in_place = make("walk", "cpu", Ogre::Vector3::ZERO, "true");
  EXPECT_NE(&whole->asset(), &in_place->asset());
  Ogre::SceneNode* node = in_place->getParentSceneNode();
  in_place->set_root(node);
  node->setPosition(Ogre::Vector3::ZERO);
  node->setScale(Ogre::Vector3(3));
  for (int i = 0; i < 10; ++i)
    in_place->add_time(0.05);
  anic_root_motion step = ANIC_INIT(anic_root_motion);
  ASSERT_TRUE(in_place->asset().root_step(0, 0, 0.5, &step));
  ASSERT_TRUE(step.moves && step.turns);
  const Ogre::Vector3 way(static_cast<float>(step.move[0]), static_cast<float>(step.move[2]),
                          static_cast<float>(-step.move[1]));
  EXPECT_GT(way.length(), 0.01F);
  EXPECT_LT(node->getPosition().distance(3 * way), 1e-4F) << "the file has z up";
  EXPECT_NEAR(node->getOrientation().getYaw().valueRadians(), step.turn, 1e-4);
  in_place->add_time(-0.5);
  EXPECT_LT(node->getPosition().length(), 1e-4F);
  EXPECT_NEAR(node->getOrientation().getYaw().valueRadians(), 0, 1e-4);
}

TEST_F(OgreEntity, LeavesOutMeshesThatAreNotThere) {
  Entity* scene = make("scene", "cpu");
  scene->keep_previous(true);
  for (int f = 0; f < 12; ++f) {
    draw();
    scene->add_time(1 / 24.0);
  }
}

TEST_F(OgreEntity, RefusesWhatIsNotThere) {
  EXPECT_THROW(make("no_such_file", "cpu"), Ogre::Exception);
  const Ogre::NameValuePairList damaged = {{"file", "MANIFEST"}};
  EXPECT_THROW(scene_->createMovableObject("damaged", EntityFactory::kType, &damaged),
               Ogre::Exception);
  EXPECT_THROW(scene_->createMovableObject("nothing", EntityFactory::kType), Ogre::Exception);
  EXPECT_THROW(make("limb_default", "cpu")->set_clip("no such clip"), Ogre::Exception);
}

}  // namespace
}  // namespace anicodec::ogre
