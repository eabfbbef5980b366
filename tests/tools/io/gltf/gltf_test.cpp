// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf.h"

#include "codec/sequence/error.h"
#include "tests/tools/gltf_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/load_sequence.h"

#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;
using testing::SizeIs;

MeshSequence parse(const GltfScene& scene, const GltfOptions& options = {}) {
  auto missing = [](const std::string& path) -> std::string {
    throw Error(ErrorKind::kInput, path + ": No such file or directory");
  };
  MeshSequence sequence = parse_gltf(scene.glb(), "a.glb", missing, options);
  check(sequence);
  return sequence;
}

std::string gltf_fault(const GltfScene& scene, const GltfOptions& options = {}) {
  return fault([&] { parse(scene, options); });
}

std::vector<float> vertex(const MeshSequence& s, size_t frame, size_t v) {
  auto positions = s.frame(frame);
  return {positions.begin() + static_cast<std::ptrdiff_t>(3 * v),
          positions.begin() + static_cast<std::ptrdiff_t>(3 * v + 3)};
}

/// x of a vertex, frame by frame.
std::vector<float> track(const MeshSequence& s, size_t v, size_t axis = 0) {
  std::vector<float> out;
  for (size_t f = 0; f < s.frame_count; ++f)
    out.push_back(s.frame(f)[3 * v + axis]);
  return out;
}

GltfOptions at_rate(uint32_t fps) {
  GltfOptions options;
  options.rate = FrameRate{fps, 1, false};
  return options;
}

TEST(Gltf, TakesASceneWithoutAnimationAsOneFrame) {
  MeshSequence s = parse(triangle_scene());
  EXPECT_EQ(s.frame_count, 1U);
  EXPECT_THAT(s.positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(s.polygons.corners, ElementsAre(0, 1, 2));
  EXPECT_EQ(s.up, UpAxis::kY);
  EXPECT_THAT(s.parts.names, ElementsAre("object"));
  EXPECT_THAT(s.parts.of_polygon, ElementsAre(0U));
}

TEST(Gltf, InterpolatesTranslationsLinearly) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 1}, scene.vectors({0, 0, 0, 4, 0, 0}));
  EXPECT_THAT(track(parse(scene, at_rate(4)), 1), ElementsAre(1, 2, 3, 4, 5));
}

TEST(Gltf, HoldsStepsUntilTheNextKey) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 0.5, 1}, scene.vectors({0, 0, 0, 4, 0, 0, 8, 0, 0}), "STEP");
  EXPECT_THAT(track(parse(scene, at_rate(4)), 0), ElementsAre(0, 0, 4, 4, 8));
}

TEST(Gltf, TakesKeysThatRoundedTimesMissByLittle) {
  GltfScene scene = triangle_scene();
  std::vector<float> times, values;
  for (int f = 0; f <= 24; ++f) {
    times.push_back(static_cast<float>(f / 24.0));
    values.insert(values.end(), {static_cast<float>(f), 0, 0});
  }
  scene.animate(0, "translation", times, scene.vectors(values), "STEP");
  std::vector<float> expected(25);
  for (size_t f = 0; f < expected.size(); ++f)
    expected[f] = static_cast<float>(f);
  EXPECT_EQ(track(parse(scene, at_rate(24)), 0), expected);
}

TEST(Gltf, FollowsCubicSplines) {
  GltfScene scene = triangle_scene();
  // In-tangent, value, out-tangent of two keys: x leaves at speed 2 and arrives at speed 0.
  scene.animate(0, "translation", {0, 1},
                scene.vectors({0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}),
                "CUBICSPLINE");
  // 2 (s^3 - 2 s^2 + s) + 3 s^2 - 2 s^3
  EXPECT_THAT(track(parse(scene, at_rate(4)), 0),
              Pointwise(FloatNear(1e-6F), {0.0F, 0.4375F, 0.75F, 0.9375F, 1.0F}));
}

TEST(Gltf, TurnsTheShortWayAtConstantSpeed) {
  GltfScene scene = triangle_scene();
  const float half = std::sqrt(0.5F);
  // A quarter turn about z, its quaternion negated.
  scene.animate(0, "rotation", {0, 1}, scene.quads({0, 0, 0, 1, 0, 0, -half, -half}));
  MeshSequence s = parse(scene, at_rate(3));
  for (size_t f = 0; f < 4; ++f) {
    const double angle = std::numbers::pi / 6 * static_cast<double>(f);
    EXPECT_NEAR(vertex(s, f, 1)[0], std::cos(angle), 1e-6);
    EXPECT_NEAR(vertex(s, f, 1)[1], std::sin(angle), 1e-6);
  }
}

TEST(Gltf, MovesChildrenWithTheirParents) {
  GltfScene scene = triangle_scene();
  scene.document["nodes"] = {{{"children", {1}}, {"scale", {2, 2, 2}}},
                             {{"mesh", 0}, {"translation", {1, 0, 0}}}};
  EXPECT_THAT(parse(scene).positions, ElementsAre(2, 0, 0, 4, 0, 0, 2, 2, 0));
}

TEST(Gltf, PutsWhatIsHiddenAtAPointAndLeavesOutWhatIsNeverShown) {
  GltfScene scene = triangle_scene();
  nlohmann::json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  scene.document["nodes"] = {{{"children", {1}}, {"extensions", hidden}},
                             {{"mesh", 0}, {"translation", {5, 0, 0}}},
                             {{"mesh", 0}, {"extensions", hidden}}};
  scene.document["scenes"][0]["nodes"] = {0, 2};
  scene.document["extensionsRequired"] = {"KHR_node_visibility", "KHR_animation_pointer"};
  scene.animate(0, "pointer", {0, 0.5}, scene.scalars({0, 1}), "STEP");
  nlohmann::json& target = scene.document["animations"][0]["channels"][0]["target"];
  target.erase("node");
  nlohmann::json& pointer = target["extensions"]["KHR_animation_pointer"]["pointer"];
  pointer = "/nodes/0/extensions/KHR_node_visibility/visible";
  const MeshSequence shown = parse(scene, at_rate(2));
  EXPECT_EQ(shown.vertex_count, 3U);
  EXPECT_THAT(track(shown, 1), ElementsAre(5, 6));
  EXPECT_THAT(track(shown, 0), ElementsAre(5, 5));

  pointer = "/nodes/1/translation";
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/animations/0/channels/0: /accessors/"));
  pointer = "/nodes/7/translation";
  EXPECT_THAT(gltf_fault(scene), HasSubstr("channels/0/target/extensions/KHR_animation_pointer"
                                           "/pointer: '/nodes/7/translation' leads to no"));
  pointer = "/meshes/0/weights";
  EXPECT_THAT(gltf_fault(scene), HasSubstr("whose mesh has no morph target"));
}

GltfScene skinned_scene() {
  GltfScene scene = triangle_scene();
  scene.document["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                             {{"translation", {0, 0, 0}}},
                             {{"translation", {0, 5, 0}}}};
  scene.document["scenes"][0]["nodes"] = {0, 1, 2};
  scene.primitive()["attributes"]["JOINTS_0"] = scene.joints({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
  scene.primitive()["attributes"]["WEIGHTS_0"] =
      scene.quads({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0});
  const size_t binds = scene.matrices({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -5, 0, 1});
  scene.document["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", binds}}};
  return scene;
}

TEST(Gltf, BlendsTheJointsOfSkinsWhateverTheirNodeDoes) {
  GltfScene scene = skinned_scene();
  scene.animate(2, "translation", {0, 1}, scene.vectors({0, 5, 0, 0, 9, 0}));
  MeshSequence s = parse(scene, at_rate(1));
  EXPECT_THAT(s.frame(0), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(s.frame(1), ElementsAre(0, 0, 0, 1, 4, 0, 0, 3, 0));
}

TEST(Gltf, ScalesJointWeightsToSumToOne) {
  GltfScene scene = skinned_scene();
  scene.primitive()["attributes"]["WEIGHTS_0"] = scene.quads({2, 0, 0, 0, 0, 0, 0, 0, 2, 2, 0, 0});
  EXPECT_THAT(parse(scene).positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
}

GltfScene morphed_scene() {
  GltfScene scene = triangle_scene();
  scene.primitive()["targets"] = {{{"POSITION", scene.vectors({1, 0, 0, 0, 0, 0, 0, 0, 0})}},
                                  {{"POSITION", scene.vectors({0, 0, 0, 0, 2, 0, 0, 0, 0})}}};
  return scene;
}

TEST(Gltf, AddsMorphTargetsByTheirWeights) {
  GltfScene scene = morphed_scene();
  scene.animate(0, "weights", {0, 1}, scene.scalars({0, 1, 1, 0}));
  MeshSequence s = parse(scene, at_rate(2));
  EXPECT_THAT(s.frame(0), ElementsAre(0, 0, 0, 1, 2, 0, 0, 1, 0));
  EXPECT_THAT(s.frame(1), ElementsAre(0.5, 0, 0, 1, 1, 0, 0, 1, 0));
  EXPECT_THAT(s.frame(2), ElementsAre(1, 0, 0, 1, 0, 0, 0, 1, 0));
}

TEST(Gltf, TakesWeightsOfTheNodeBeforeThoseOfTheMesh) {
  GltfScene scene = morphed_scene();
  scene.document["meshes"][0]["weights"] = {1, 0};
  EXPECT_THAT(vertex(parse(scene), 0, 0), ElementsAre(1, 0, 0));
  scene.document["nodes"][0]["weights"] = {3, 0};
  EXPECT_THAT(vertex(parse(scene), 0, 0), ElementsAre(3, 0, 0));
}

TEST(Gltf, PutsSparseValuesInPlace) {
  GltfScene scene = triangle_scene();
  scene.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", scene.view(std::vector<uint8_t>{2})}, {"componentType", 5121}}},
      {"values", {{"bufferView", scene.view(std::vector<float>{7, 8, 9})}}}};
  EXPECT_THAT(parse(scene).positions, ElementsAre(0, 0, 0, 1, 0, 0, 7, 8, 9));
  scene.document["accessors"][0].erase("bufferView");
  EXPECT_THAT(parse(scene).positions, ElementsAre(0, 0, 0, 0, 0, 0, 7, 8, 9));
}

TEST(Gltf, ScalesNormalisedIntegers) {
  GltfScene scene = triangle_scene();
  const size_t accessor = scene.accessor(
      std::vector<int16_t>{32767, -32767, -32768, 0, 0, 0, 0, 0, 0}, "VEC3", 5122, 3);
  scene.primitive()["attributes"]["POSITION"] = accessor;
  EXPECT_THAT(vertex(parse(scene), 0, 0), ElementsAre(32767, -32767, -32768));
  scene.document["accessors"][accessor]["normalized"] = true;
  EXPECT_THAT(vertex(parse(scene), 0, 0), ElementsAre(1, -1, -1));
}

TEST(Gltf, MakesTrianglesOfStripsAndFans) {
  GltfScene scene = triangle_scene();
  scene.primitive()["attributes"]["POSITION"] = scene.vectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  scene.primitive()["mode"] = 5;
  EXPECT_THAT(parse(scene).polygons.corners, ElementsAre(0, 1, 2, 2, 1, 3));
  scene.primitive()["mode"] = 6;
  EXPECT_THAT(parse(scene).polygons.corners, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Gltf, SharesVerticesOfPrimitivesWithTheSameAccessors) {
  GltfScene scene = triangle_scene();
  scene.document["materials"] = {{{"name", "red"}}, {{"name", "blue"}}};
  nlohmann::json& primitives = scene.document["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[0]["material"] = 1;
  primitives[1]["indices"] = scene.indices({2, 1, 0});
  MeshSequence s = parse(scene);
  EXPECT_EQ(s.vertex_count, 3U);
  EXPECT_THAT(s.polygons.corners, ElementsAre(0, 1, 2, 2, 1, 0));
  EXPECT_THAT(s.materials.names, ElementsAre("red", "blue"));
  EXPECT_THAT(s.materials.of_polygon, ElementsAre(1U, kNoLabel));
}

TEST(Gltf, KeepsAttributesAndTurnsNormalsWithTheFirstFrame) {
  GltfScene scene = triangle_scene();
  auto& attributes = scene.primitive()["attributes"];
  attributes["NORMAL"] = scene.vectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
  attributes["TEXCOORD_0"] = scene.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 5126, 2);
  attributes["COLOR_0"] = scene.vectors({1, 0, 0, 0, 1, 0, 0, 0, 1});
  const float half = std::sqrt(0.5F);
  scene.document["nodes"][0]["rotation"] = {half, 0, 0, half};  // z -> -y
  MeshSequence s = parse(scene);
  ASSERT_THAT(s.attributes, SizeIs(3));
  EXPECT_EQ(s.attributes[0].name, "COLOR_0");
  EXPECT_THAT(s.attributes[0].values, ElementsAre(1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1));
  EXPECT_THAT(s.attributes[1].values, ElementsAre(0, 1, 1, 1, 0, 0));  // v upwards
  EXPECT_EQ(s.attributes[2].kind, AttributeKind::kNormal);
  EXPECT_NEAR(s.attributes[2].values[1], -1, 1e-6);
}

GltfScene two_meshes() {
  GltfScene scene = triangle_scene();
  scene.document["meshes"].push_back(scene.document["meshes"][0]);
  scene.document["meshes"][1]["name"] = "second";
  scene.document["nodes"].push_back({{"mesh", 1}, {"translation", {9, 0, 0}}});
  scene.document["scenes"][0]["nodes"] = {0, 1};
  return scene;
}

TEST(Gltf, JoinsTheMeshesOfASceneOrTakesTheOneNamed) {
  GltfScene scene = two_meshes();
  MeshSequence s = parse(scene);
  EXPECT_THAT(s.polygons.corners, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(s.parts.names, ElementsAre("object", "second"));
  EXPECT_THAT(s.parts.of_polygon, ElementsAre(0U, 1U));
  GltfOptions options;
  options.mesh = "second";
  EXPECT_THAT(vertex(parse(scene, options), 0, 0), ElementsAre(9, 0, 0));
  options.mesh = "object";
  EXPECT_THAT(vertex(parse(scene, options), 0, 0), ElementsAre(0, 0, 0));
  options.mesh = "third";
  EXPECT_EQ(fault([&] { parse(scene, options); }, ErrorKind::kUsage),
            "a.glb: there is no mesh 'third' of triangles; the meshes and nodes are: '', 'object', "
            "'second', 'triangle'");
}

TEST(Gltf, TakesTheClipNamedOrNumberedOrTheFirstThatMovesAnything) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 1}, scene.vectors({1, 0, 0, 1, 0, 0}), "LINEAR", "still");
  scene.animate(0, "translation", {0, 1}, scene.vectors({2, 0, 0, 3, 0, 0}), "LINEAR", "walk");
  scene.animate(0, "translation", {0, 1}, scene.vectors({4, 0, 0, 5, 0, 0}), "LINEAR", "0");
  auto first_x = [&](const std::string& clip) {
    GltfOptions options = at_rate(1);
    options.clip = clip;
    return parse(scene, options).positions[0];
  };
  EXPECT_EQ(first_x(""), 2);
  EXPECT_EQ(first_x("still"), 1);
  EXPECT_EQ(first_x("1"), 2);
  EXPECT_EQ(first_x("0"), 4) << "a name comes before a number";
  EXPECT_EQ(first_x("none"), 0);
  EXPECT_EQ(fault([&] { first_x("run"); }, ErrorKind::kUsage),
            "a.glb: there is no clip 'run'; the clips are: 'still', 'walk', '0'");
}

TEST(Gltf, PlaysAnimationsTogetherThatMoveDifferentThings) {
  GltfScene scene = two_meshes();
  scene.animate(0, "translation", {0, 1}, scene.vectors({0, 0, 0, 1, 0, 0}), "LINEAR", "walk");
  scene.animate(0, "translation", {0, 1}, scene.vectors({0, 0, 0, 5, 0, 0}), "LINEAR", "run");
  scene.animate(1, "translation", {1, 2}, scene.vectors({9, 0, 0, 8, 0, 0}), "LINEAR", "roll");
  std::vector<std::string> notes;
  GltfOptions options = at_rate(1);
  options.note = [&](const std::string& text) { notes.push_back(text); };
  const MeshSequence usual = parse(scene, options);
  EXPECT_EQ(usual.name, "walk");
  EXPECT_THAT(track(usual, 0), ElementsAre(0, 1, 1));
  EXPECT_THAT(track(usual, 3), ElementsAre(9, 9, 8));
  EXPECT_THAT(notes, ElementsAre("other takes are left out: 'run'; --clip chooses one, encode "
                                 "takes all as clips"));
  options.clip = "run+2";
  const MeshSequence chosen = parse(scene, options);
  EXPECT_THAT(track(chosen, 0), ElementsAre(0, 5, 5));
  EXPECT_THAT(track(chosen, 3), ElementsAre(9, 9, 8));
  options.clip = "run";
  EXPECT_THAT(track(parse(scene, options), 3), ElementsAre(9, 9));
  options.clip = "run+fly";
  EXPECT_THAT(fault([&] { parse(scene, options); }, ErrorKind::kUsage),
              HasSubstr("there is no clip 'fly'"));
  EXPECT_THAT(notes, SizeIs(1)) << "who chooses is told nothing";
  scene.document["animations"].erase(1);
  options.clip.clear();
  EXPECT_EQ(parse(scene, options).name, "") << "there is no other";
  EXPECT_THAT(notes, SizeIs(1));
}

TEST(Gltf, TakesOfTheSameAreClipsEachWithWhatMovesBesides) {
  GltfScene scene = two_meshes();
  const auto key = [&](float to) { return scene.vectors({0, 0, 0, to, 0, 0}); };
  scene.animate(0, "translation", {0, 1}, key(1), "LINEAR", "walk");
  scene.animate(0, "translation", {0, 1}, key(5), "LINEAR", "run");
  scene.animate(1, "translation", {0, 1}, key(2), "LINEAR", "roll");
  scene.animate(0, "translation", {0, 1}, key(7), "LINEAR", "run");
  scene.animate(1, "translation", {0, 1}, key(0), "LINEAR", "wait");
  std::vector<std::string> notes;
  GltfOptions options = at_rate(1);
  options.note = [&](const std::string& text) { notes.push_back(text); };
  const auto clips = [&](const std::vector<std::string>& names) {
    std::string text;
    for (const MeshSequence& clip : parse_gltf_clips(scene.glb(), "a.glb", {}, options, names))
      text += clip.name + " " + std::to_string(static_cast<int>(track(clip, 0)[1])) + " " +
              std::to_string(static_cast<int>(track(clip, 3)[1])) + "; ";
    return text;
  };
  EXPECT_EQ(clips({}), "walk 1 2; run 5 2; run 2 7 2; ");
  EXPECT_THAT(notes, ElementsAre("left out, as they move no vertex: 'wait'"));
  EXPECT_EQ(clips({"all"}), "walk 1 9; run 5 9; roll 0 2; run 2 7 9; ");
  EXPECT_EQ(clips({"roll"}), "roll 0 2; ");
  options.memory_limit = uint64_t{3} * 2 * 6 * 3 * sizeof(float) - 1;
  EXPECT_THAT(fault([&] { clips({}); }), HasSubstr("are allowed")) << "of all clips together";
}

TEST(Gltf, SamplesAtTheGridOfTheKeys) {
  auto rate_of = [](const std::vector<float>& times) {
    GltfScene scene = triangle_scene();
    std::vector<float> values;
    for (float t : times)
      values.insert(values.end(), {t, 0, 0});
    scene.animate(0, "translation", times, scene.vectors(values));
    MeshSequence s = parse(scene);
    EXPECT_FALSE(s.rate.assumed);
    return std::pair(s.rate.value(), s.frame_count);
  };
  EXPECT_EQ(rate_of({0, 1}), std::pair(30.0, 31U));
  EXPECT_EQ(rate_of({0, 1 / 60.0F, 2 / 60.0F, 3 / 60.0F}), std::pair(60.0, 4U));
  EXPECT_EQ(rate_of({0, 1 / 25.0F, 5 / 25.0F, 24 / 25.0F}), std::pair(25.0, 25U));
  EXPECT_EQ(rate_of({0, 1 / 12.0F, 2 / 12.0F}), std::pair(12.0, 3U));
  // A hard cut: two keys almost at once.
  EXPECT_EQ(rate_of({0, 1 / 50.0F, 2 / 50.0F, 2.01F / 50.0F, 3 / 50.0F, 4 / 50.0F}).first, 50.0);
}

TEST(Gltf, CoversAnAnimationWhoseKeysStandOnNoGrid) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 0.3137F, 1.0071F},
                scene.vectors({0, 0, 0, 1, 0, 0, 2, 0, 0}));
  GltfOptions options;
  std::vector<std::string> notes;
  options.note = [&notes](const std::string& text) { notes.push_back(text); };
  const MeshSequence s = parse(scene, options);
  EXPECT_GE(s.rate.value(), 30);
  EXPECT_LT(s.rate.value(), 32);
  EXPECT_EQ(s.frame_count, 32U);
  EXPECT_FLOAT_EQ(s.frame(31)[0], 2) << "the last key is a frame";
  EXPECT_THAT(notes, ElementsAre(testing::HasSubstr("no common frames")));
  notes.clear();
  options.rate = FrameRate{2, 1, false};
  parse(scene, options);
  EXPECT_THAT(notes, ElementsAre(testing::HasSubstr("behind the last frame")));
}

TEST(Gltf, StartsAtTheFirstKey) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {2, 3}, scene.vectors({2, 0, 0, 3, 0, 0}));
  MeshSequence s = parse(scene, at_rate(2));
  EXPECT_EQ(s.start_time, 2);
  EXPECT_THAT(track(s, 0), ElementsAre(2, 2.5, 3));
}

TEST(Gltf, ReadsBuffersBesideTheFileAndInIt) {
  TemporaryFolder folder;
  GltfScene scene = triangle_scene();
  scene.document["buffers"][0]["uri"] = "the%20data.bin";
  folder.write("the data.bin", scene.binary);
  std::string path = folder.write("a.gltf", scene.document.dump());
  EXPECT_EQ(load_sequence(std::vector{path}).vertex_count, 3U);
  scene.document["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  path = folder.write("b.gltf", scene.document.dump());
  EXPECT_THAT(load_sequence(std::vector{path}).positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
}

// Faults are named by their JSON pointer.

TEST(GltfFaults, NameMissingBuffers) {
  GltfScene scene = triangle_scene();
  scene.document["buffers"][0]["uri"] = "absent.bin";
  EXPECT_EQ(gltf_fault(scene),
            "a.glb: /buffers/0/uri: the buffer is missing: absent.bin: No such file or directory");
  scene.document["buffers"][0]["uri"] = "http://example.org/a.bin";
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/buffers/0/uri: 'http://example.org/a.bin' is not"));
  scene.document["buffers"][0]["uri"] = "data:text/plain,abc";
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/buffers/0/uri: the data URI is not in base64"));
  scene.document["buffers"][0].erase("uri");
  scene.document["buffers"].push_back({{"byteLength", 4}});
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/buffers/1: the buffer is missing"));
  scene.document["buffers"].erase(1);
  scene.document["buffers"][0]["byteLength"] = 400;
  EXPECT_EQ(gltf_fault(scene),
            "a.glb: /buffers/0: the buffer has 36 bytes of the 400 of its byteLength");
}

TEST(GltfFaults, NameRangesThatAreOutOfBounds) {
  GltfScene scene = triangle_scene();
  scene.document["accessors"][0]["count"] = 4;
  EXPECT_EQ(gltf_fault(scene),
            "a.glb: /accessors/0: 4 elements end at byte 48, out of bounds: /bufferViews/0 has 36 "
            "bytes");
  scene = triangle_scene();
  scene.document["accessors"][0]["byteOffset"] = 4;
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/accessors/0: 3 elements end at byte 40"));
  scene = triangle_scene();
  scene.document["bufferViews"][0]["byteOffset"] = 8;
  EXPECT_EQ(gltf_fault(scene),
            "a.glb: /bufferViews/0: bytes 8 to 44 are out of bounds; /buffers/0 has 36");
  scene = triangle_scene();
  scene.document["bufferViews"][0]["byteStride"] = 8;
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/accessors/0: elements of 12 bytes"));
  scene = triangle_scene();
  scene.document["accessors"][0]["count"] = -1;
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/accessors/0/count: -1 is not a whole number"));
}

TEST(GltfFaults, NameIndicesThatAreOutOfRange) {
  GltfScene scene = triangle_scene();
  scene.document["accessors"][0]["bufferView"] = 1;
  EXPECT_EQ(gltf_fault(scene),
            "a.glb: /accessors/0/bufferView: 1 is out of range; there are 1 buffer views");
  scene = triangle_scene();
  scene.document["nodes"][0]["mesh"] = 7;
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/nodes/0/mesh: 7 is out of range"));
  scene = triangle_scene();
  scene.primitive()["indices"] = scene.indices({0, 1, 3});
  EXPECT_EQ(gltf_fault(scene),
            "a.glb: /meshes/0/primitives/0/indices: index 2 is 3, out of bounds; there are 3 "
            "vertices");
  scene = skinned_scene();
  scene.document["skins"][0]["joints"] = {1};
  EXPECT_THAT(gltf_fault(scene),
              HasSubstr("/meshes/0/primitives/0/attributes/JOINTS_0: joint 1 of vertex 1 is out of "
                        "bounds; /skins/0 has 1"));
  scene = triangle_scene();
  scene.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", scene.view(std::vector<uint8_t>{3})}, {"componentType", 5121}}},
      {"values", {{"bufferView", scene.view(std::vector<float>{7, 8, 9})}}}};
  EXPECT_THAT(gltf_fault(scene),
              HasSubstr("/attributes/POSITION: sparse index 3 is out of bounds"));
}

TEST(GltfFaults, NameCyclesOfNodes) {
  GltfScene scene = triangle_scene();
  scene.document["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
  EXPECT_THAT(gltf_fault(scene), HasSubstr("a.glb: /nodes/1: the node is cyclic"));
  scene.document["nodes"] = {{{"mesh", 0}, {"children", {0}}}};
  EXPECT_THAT(gltf_fault(scene), HasSubstr("a.glb: /nodes/0: the node is cyclic"));
  scene.document["nodes"] = {{{"mesh", 0}, {"children", {1, 1}}}, {{"name", "twice"}}};
  EXPECT_EQ(gltf_fault(scene), "a.glb: /nodes/0/children/1: node 1 is also a child of node 0");
}

TEST(GltfFaults, NameNumbersThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  GltfScene scene = skinned_scene();
  scene.primitive()["attributes"]["WEIGHTS_0"] =
      scene.quads({1, 0, 0, 0, nan, 0, 0, 0, 0.5, 0.5, 0, 0});
  EXPECT_THAT(gltf_fault(scene),
              HasSubstr("/meshes/0/primitives/0/attributes/WEIGHTS_0: element 1 is not finite"));
  scene = morphed_scene();
  scene.animate(0, "weights", {0, 1}, scene.scalars({0, 1, nan, 0}));
  EXPECT_THAT(gltf_fault(scene),
              HasSubstr("/animations/0/samplers/0/output: element 2 is not finite"));
  scene = triangle_scene();
  scene.primitive()["attributes"]["POSITION"] = scene.vectors({0, 0, 0, 1, 0, 0, 0, nan, 0});
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/attributes/POSITION: element 2 is not finite"));
}

TEST(Gltf, TakesAnAnimationOfOneTimeAsOneFrame) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {1}, scene.vectors({7, 0, 0}));
  const MeshSequence one = parse(scene);
  EXPECT_EQ(one.frame_count, 1U);
  EXPECT_EQ(one.start_time, 1);
  EXPECT_THAT(vertex(one, 0, 0), ElementsAre(7, 0, 0));
  // One with a length comes first.
  scene.animate(0, "translation", {0, 1}, scene.vectors({1, 0, 0, 2, 0, 0}), "LINEAR", "walk");
  EXPECT_EQ(parse(scene, at_rate(1)).frame_count, 2U);
}

TEST(GltfFaults, NameAnimationsWithoutKeys) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {1}, scene.vectors({1, 0, 0}));
  GltfOptions options;
  options.clip = "none";
  EXPECT_EQ(parse(scene, options).frame_count, 1U);
  scene.document["animations"][0]["channels"] = nlohmann::json::array();
  EXPECT_THAT(gltf_fault(scene), HasSubstr("a.glb: /animations/0: the animation has no channel"));
}

TEST(GltfFaults, NameChannelsThatDoNotFit) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {1, 0.5}, scene.vectors({1, 0, 0, 2, 0, 0}));
  EXPECT_THAT(gltf_fault(scene),
              HasSubstr("/animations/0/samplers/0/input: the time of key 1 is before"));
  scene = triangle_scene();
  scene.animate(0, "translation", {0, 1}, scene.vectors({1, 0, 0}));
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/animations/0/channels/0: /accessors/"));
  scene = triangle_scene();
  scene.animate(0, "weights", {0, 1}, scene.scalars({1, 0}));
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/animations/0/channels/0: animates weights of node 0"));
  scene = triangle_scene();
  scene.animate(0, "translation", {0, 1e9}, scene.vectors({1, 0, 0, 2, 0, 0}));
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/animations/0: from 0.000000 to"));
}

TEST(GltfFaults, NameWhatHasTheWrongType) {
  GltfScene scene = triangle_scene();
  scene.document["nodes"][0]["translation"] = {1, 2};
  EXPECT_EQ(gltf_fault(scene), "a.glb: /nodes/0/translation: 2 numbers; 3 are expected");
  scene.document["nodes"][0]["translation"] = "far";
  EXPECT_EQ(gltf_fault(scene), "a.glb: /nodes/0/translation: an array is expected");
  scene = triangle_scene();
  scene.document["meshes"][0].erase("primitives");
  EXPECT_EQ(gltf_fault(scene), "a.glb: /meshes/0: 'primitives' is missing");
  scene = triangle_scene();
  scene.document["asset"]["version"] = "1.0";
  EXPECT_THAT(gltf_fault(scene), HasSubstr("/asset/version: version '1.0'"));
}

TEST(GltfFaults, AreUnsupportedForUnknownRequiredExtensions) {
  GltfScene scene = triangle_scene();
  scene.document["extensionsRequired"] = {"KHR_mesh_quantization", "ACME_ripples"};
  EXPECT_EQ(fault([&] { parse(scene); }, ErrorKind::kUnsupported),
            "a.glb: /extensionsRequired/1: extension 'ACME_ripples' is required, but not "
            "known");
}

TEST(GltfFaults, TellDamagedContainers) {
  auto parse_bytes = [](const std::string& bytes) {
    return fault(
        [&] { parse_gltf(bytes, "a.glb", [](const std::string&) { return std::string(); }); });
  };
  const std::string glb = triangle_scene().glb();
  EXPECT_EQ(parse_bytes("glTF"), "a.glb: the GLB is truncated: 4 bytes");
  EXPECT_THAT(parse_bytes(glb.substr(0, glb.size() - 4)), HasSubstr("the GLB header says"));
  EXPECT_EQ(parse_bytes("{"), "a.glb: is not valid JSON, at byte 2 of its text");
  EXPECT_EQ(parse_bytes("[]"), "a.glb: the JSON is not an object");
  EXPECT_EQ(parse_bytes(std::string(100000, '[')),
            "a.glb: the JSON is nested deeper than 64 levels");
  EXPECT_EQ(parse_bytes("{}"), "a.glb: the document: 'asset' is missing");
}

TEST(GltfFaults, TellWhenTheBakeIsTooLarge) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 1000}, scene.vectors({1, 0, 0, 2, 0, 0}));
  GltfOptions options = at_rate(30);
  options.memory_limit = 1000000;
  EXPECT_EQ(gltf_fault(scene, options),
            "a.glb: 3 vertices x 30001 frames take 1080036 bytes of memory, more than the 1000000 "
            "that are allowed");
}

TEST(GltfFaults, TellWhenInstancesAreTooMany) {
  GltfScene scene = triangle_scene();
  const nlohmann::json node = scene.document["nodes"][0];
  for (uint32_t i = 1; i < 1000; ++i) {
    scene.document["nodes"].push_back(node);
    scene.document["scenes"][0]["nodes"].push_back(i);
  }
  EXPECT_EQ(parse(scene).vertex_count, 3000U);
  GltfOptions options;
  options.memory_limit = 10000;
  EXPECT_THAT(gltf_fault(scene, options), HasSubstr("are left of the 10000 that are allowed"));
}

TEST(GltfFaults, NameCountsThatNoByteBacks) {
  GltfScene scene = triangle_scene();
  nlohmann::json& accessor = scene.document["accessors"][0];
  accessor.erase("bufferView");
  EXPECT_EQ(parse(scene).vertex_count, 3U);
  accessor["count"] = 1000000;
  scene.primitive()["attributes"] = {{"POSITION", 0}};
  scene.primitive().erase("indices");
  EXPECT_THAT(gltf_fault(scene),
              HasSubstr("/accessors/0 has 1000000 elements and no buffer view, but the document"));
}

TEST(GltfFaults, NameCompressedViewsThatCannotHoldWhatTheySay) {
  GltfScene scene = triangle_scene();
  scene.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0},      {"byteOffset", 0},   {"byteLength", 16},
      {"byteStride", 12}, {"count", 50000000}, {"mode", "ATTRIBUTES"}};
  EXPECT_THAT(gltf_fault(scene),
              HasSubstr("50000000 elements of 12 bytes cannot come from 16 compressed bytes"));
}

TEST(GltfFaults, NameBuffersOutsideTheFolder) {
  for (const char* uri : {"../a.bin", "sub/../../a.bin", "%2e%2e/a.bin", "./.././a.bin"}) {
    GltfScene scene = triangle_scene();
    scene.document["buffers"].push_back({{"byteLength", 1}, {"uri", uri}});
    const auto some = [](const std::string&) { return std::string("x"); };
    EXPECT_THAT(fault([&] { parse_gltf(scene.glb(), "a.glb", some); }),
                HasSubstr("a.glb: /buffers/1/uri: '"));
    GltfOptions options;
    options.allow_outside = true;
    EXPECT_EQ(parse_gltf(scene.glb(), "a.glb", some, options).vertex_count, 3U);
  }
  GltfScene scene = triangle_scene();
  scene.document["buffers"].push_back({{"byteLength", 1}, {"uri", "sub/../a.bin"}});
  std::string opened;
  parse_gltf(scene.glb(), "a.glb", [&](const std::string& path) {
    opened = path;
    return std::string("x");
  });
  EXPECT_EQ(opened, "a.bin");
}

/// A triangle shown by the last of a chain of nodes, with as many primitives, morph targets and materials.
GltfScene large_scene(size_t count) {
  GltfScene scene = triangle_scene();
  nlohmann::json& mesh = scene.document["meshes"][0];
  const nlohmann::json primitive = mesh["primitives"][0];
  mesh["primitives"] = nlohmann::json(count, primitive);
  nlohmann::json& nodes = scene.document["nodes"];
  nodes = nlohmann::json::array();
  for (size_t n = 0; n + 1 < count; ++n)
    nodes.push_back({{"children", nlohmann::json::array({n + 1})}});
  nodes.push_back({{"mesh", 0}});
  scene.document["materials"] = nlohmann::json(count, nlohmann::json::object({{"name", "paint"}}));
  nlohmann::json morphed = primitive;
  morphed["targets"] = nlohmann::json(
      count, nlohmann::json::object({{"POSITION", primitive["attributes"]["POSITION"]}}));
  scene.document["meshes"].push_back({{"primitives", nlohmann::json::array({morphed})}});
  nodes.push_back({{"mesh", 1}});
  scene.document["scenes"] =
      nlohmann::json::array({{{"nodes", nlohmann::json::array({0, count})}}});
  scene.document["scene"] = 0;
  return scene;
}

TEST(Gltf, CostsAreLinearInAllCounts) {
  constexpr size_t kCount = 200'000;
  const std::clock_t before = std::clock();
  const MeshSequence sequence = parse(large_scene(kCount));
  EXPECT_EQ(sequence.polygons.size(), kCount + 1);
  EXPECT_LT(std::clock() - before, 60 * CLOCKS_PER_SEC);  // the square would be half an hour
}

}  // namespace
}  // namespace anicodec::tools
