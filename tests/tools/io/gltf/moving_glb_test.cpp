// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/moving_glb.h"

#include "codec/sequence/error.h"
#include "tests/tools/gltf_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/gltf/gltf_container.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kExtension = "ANIC_mesh_animation";
constexpr const char* kClip = "these bytes are the clip";

/// A camera that moves, a light, and a triangle that a skin, a target and its node move; an image.
GltfScene scene_of_all() {
  GltfScene scene = triangle_scene();
  json& d = scene.document;
  d["nodes"][0]["skin"] = 0;
  d["nodes"][0]["extras"] = {{"tag", 7}};
  d["nodes"].push_back({{"name", "joint"}, {"translation", {0, 0, 1}}});
  d["nodes"].push_back({{"name", "boom"}, {"children", {3}}});
  d["nodes"].push_back({{"name", "camera"}, {"camera", 0}});
  d["scenes"][0]["nodes"] = {0, 1, 2};
  d["cameras"] =
      json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}});
  d["skins"] = json::array({{{"joints", {1}}}});
  json& attributes = scene.primitive()["attributes"];
  attributes["JOINTS_0"] = scene.joints(std::vector<uint16_t>(12));
  attributes["WEIGHTS_0"] = scene.quads({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  attributes["TEXCOORD_0"] = scene.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", 5126, 2);
  scene.primitive()["targets"] =
      json::array({{{"POSITION", scene.vectors({0, 0, 1, 0, 0, 1, 0, 0, 1})}}});
  scene.primitive()["material"] = 0;
  scene.primitive()["extras"] = "kept";
  scene.document["materials"] = json::array({{{"name", "paint"}}});
  const std::string png = "\x89PNG and so on";
  d["images"] = json::array({{{"bufferView", scene.view(std::vector<char>(png.begin(), png.end()))},
                              {"mimeType", "image/png"}},
                             {{"uri", "beside.jpg"}}});
  scene.animate(1, "translation", {0, 1}, scene.vectors({0, 0, 1, 0, 0, 2}), "LINEAR", "go");
  scene.animate(2, "translation", {0, 1}, scene.vectors({0, 0, 0, 5, 0, 0}), "LINEAR", "pan");
  json weights{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}};
  d["animations"][0]["samplers"].push_back(
      {{"input", scene.scalars({0, 1})}, {"output", scene.scalars({0, 1})}});
  weights["sampler"] = 1;
  d["animations"][0]["channels"].push_back(weights);
  return scene;
}

std::string resolve(const std::string& path) {
  if (path != "beside.jpg")
    throw Error(ErrorKind::kInput, path + ": No such file or directory");
  return "\xFF\xD8\xFF and so on";
}

std::string moving(const GltfScene& scene, const GltfOptions& options = {}) {
  const StillSurface still{{0, 0, 1, 1, 0, 1, 0, 1, 1}, {0, 0, 1, 0, 0, 1, 0, 0, 1}};
  return write_moving_glb(scene.glb(), "a.glb", resolve, options, still, kClip);
}

TEST(MovingGlb, KeepsWhatTheClipDoesNotReplace) {
  const std::string glb = moving(scene_of_all());
  const GltfContainer container = open_gltf(glb, "b.glb");
  const json& d = container.document;
  EXPECT_EQ(clip_of_glb(glb, "b.glb"), kClip);
  EXPECT_FALSE(d.contains("skins"));
  EXPECT_EQ(d["extensionsUsed"], json::array({kExtension}));
  EXPECT_FALSE(d.contains("extensionsRequired"));
  // Old nodes stay where they are, without the mesh; that of the clip is a node that nothing moves.
  EXPECT_EQ(d["nodes"][0], json({{"name", "object"}, {"extras", {{"tag", 7}}}}));
  EXPECT_EQ(d["nodes"][3]["camera"], 0);
  EXPECT_EQ(d["nodes"][4], json({{"name", "object"}, {"mesh", 0}}));
  EXPECT_EQ(d["scenes"][0]["nodes"], json({0, 1, 2, 4}));
  ASSERT_EQ(d["meshes"].size(), 1U);
  EXPECT_EQ(d["meshes"][0]["name"], "triangle");
  const json& primitive = d["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["material"], 0);
  EXPECT_EQ(primitive["extras"], "kept");
  EXPECT_FALSE(primitive.contains("targets"));
  EXPECT_EQ(primitive["extensions"][kExtension], json({{"file", 0}, {"firstVertex", 0}}));
  EXPECT_EQ(primitive["attributes"].size(), 2U);  // the surface has no normals of its own
  EXPECT_EQ(d["accessors"][primitive["attributes"]["POSITION"].get<size_t>()]["max"],
            json({1, 1, 1}));
  // The camera's animation is left, and the samplers and accessors that it needs.
  ASSERT_EQ(d["animations"].size(), 1U);
  EXPECT_EQ(d["animations"][0]["name"], "pan");
  EXPECT_EQ(d["accessors"].size(), 4U);
  EXPECT_EQ(d["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(d["images"][1]["mimeType"], "image/jpeg");
  EXPECT_FALSE(d["images"][1].contains("uri"));
  EXPECT_EQ(d["bufferViews"].size(), 4U + 2 + 1);
}

TEST(MovingGlb, ShowsTheFirstFrameToThoseWhoDoNotKnowIt) {
  const MeshSequence s = parse_gltf(moving(scene_of_all()), "b.glb", resolve, {.clip = "none"});
  EXPECT_THAT(s.positions, ElementsAre(0, 0, 1, 1, 0, 1, 0, 1, 1));
  EXPECT_THAT(s.materials.names, ElementsAre("paint"));
  EXPECT_EQ(s.attributes.size(), 1U);
}

TEST(MovingGlb, LeavesPointsAndOtherMeshesToTheirNodes) {
  GltfScene scene = scene_of_all();
  json points = scene.primitive();
  points["mode"] = 0;
  scene.document["meshes"][0]["primitives"].push_back(points);
  const std::string glb = moving(scene);
  const GltfContainer container = open_gltf(glb, "b.glb");
  const json& d = container.document;
  const json& node = d["nodes"][0];
  EXPECT_EQ(node["skin"], 0);
  EXPECT_EQ(d["skins"].size(), 1U);
  EXPECT_EQ(d["meshes"][node["mesh"].get<size_t>()]["primitives"][0]["mode"], 0);
  EXPECT_EQ(d["animations"].size(), 2U);  // the joint moves the points
}

TEST(MovingGlb, TouchesNoDataOfExtensionsThatItDoesNotKnow) {
  GltfScene scene = scene_of_all();
  scene.document["extensionsUsed"] = {"EXT_of_somebody"};
  std::string told;
  GltfOptions options;
  options.note = [&](const std::string& text) { told += text + "\n"; };
  const std::string glb = moving(scene, options);
  const GltfContainer container = open_gltf(glb, "b.glb");
  EXPECT_GE(container.document["accessors"].size(), scene.document["accessors"].size());
  EXPECT_THAT(told, HasSubstr("EXT_of_somebody refers to is not known"));
}

TEST(MovingGlb, RefusesDamage) {
  EXPECT_EQ(clip_of_glb("no glTF", "a"), std::nullopt);
  GltfScene scene = triangle_scene();
  EXPECT_EQ(clip_of_glb(scene.glb(), "a"), std::nullopt);
  scene.document["extensions"][kExtension]["files"] = json::array({{{"bufferView", 9}}});
  EXPECT_THAT(fault([&] { clip_of_glb(scene.glb(), "a.glb"); }),
              HasSubstr("/extensions/ANIC_mesh_animation/files/0/bufferView"));
  scene.document["extensions"][kExtension]["files"] = json::array({{{"bufferView", 0}}});
  scene.document["bufferViews"][0]["byteLength"] = 1e6;
  EXPECT_THAT(fault([&] { clip_of_glb(scene.glb(), "a.glb"); }), HasSubstr("/bufferViews/0"));
  EXPECT_THAT(fault([&] { moving(scene); }), HasSubstr("a.glb"));
}

}  // namespace
}  // namespace anicodec::tools
