// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Extensions of glTF that change what is baked, and what a document leaves open: names, normals, long gaps.
#include "build_paths.h"
#include "codec/sequence/error.h"
#include "codec/sequence/scene.h"
#include "tests/tools/gltf_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/gltf/glb_output.h"
#include "tools/io/gltf/gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;

constexpr float kNear = 1e-6F;

MeshSequence baked(const GltfScene& scene, GltfOptions options = {}) {
  MeshSequence s = parse_gltf(scene.glb(), "a.glb", {}, options);
  check(s);
  return s;
}

GltfOptions once_a_second() {
  GltfOptions options;
  options.rate = FrameRate{1, 1, false};
  return options;
}

void point_at(GltfScene& scene, const std::string& pointer) {
  json& target = scene.document["animations"][0]["channels"][0]["target"];
  target = {{"path", "pointer"},
            {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
}

/// Two nodes that show a triangle with two targets: x of vertex 0 by 1, y of vertex 1 by 2.
GltfScene two_that_morph() {
  GltfScene scene = triangle_scene();
  scene.primitive()["targets"] = {{{"POSITION", scene.vectors({1, 0, 0, 0, 0, 0, 0, 0, 0})}},
                                  {{"POSITION", scene.vectors({0, 0, 0, 0, 2, 0, 0, 0, 0})}}};
  scene.document["nodes"].push_back({{"mesh", 0}, {"translation", {9, 0, 0}}});
  scene.document["scenes"][0]["nodes"] = {0, 1};
  return scene;
}

TEST(GltfExtensions, PointersMoveTheWeightsOfAMeshAndSingleOnes) {
  GltfScene scene = two_that_morph();
  scene.animate(0, "weights", {0, 1}, scene.scalars({0, 0, 1, 1}));
  point_at(scene, "/meshes/0/weights");
  EXPECT_THAT(baked(scene, once_a_second()).frame(1),
              ElementsAre(1, 0, 0, 1, 2, 0, 0, 1, 0, 10, 0, 0, 10, 2, 0, 9, 1, 0));
  scene.document["nodes"][1]["weights"] = {0.5, 0};
  EXPECT_THAT(baked(scene, once_a_second()).frame(1),
              ElementsAre(1, 0, 0, 1, 2, 0, 0, 1, 0, 9.5, 0, 0, 10, 0, 0, 9, 1, 0))
      << "a node with weights of its own does not follow its mesh";
  scene = two_that_morph();
  scene.animate(0, "weights", {0, 1}, scene.scalars({0, 1}));
  point_at(scene, "/nodes/0/weights/1");
  EXPECT_THAT(baked(scene, once_a_second()).frame(1),
              ElementsAre(0, 0, 0, 1, 2, 0, 0, 1, 0, 9, 0, 0, 10, 0, 0, 9, 1, 0));
  point_at(scene, "/meshes/0/weights/0");
  EXPECT_THAT(baked(scene, once_a_second()).frame(1),
              ElementsAre(1, 0, 0, 1, 0, 0, 0, 1, 0, 10, 0, 0, 10, 0, 0, 9, 1, 0));
  for (const auto& [pointer, reason] :
       {std::pair("/nodes/0/weights/2",
                  "animates weight 2 of node 0, whose mesh has 2 morph targets"),
        {"/nodes/0/weights/x", "leads to no weight"},
        {"/meshes/4/weights", "leads to no property of a mesh"}}) {
    point_at(scene, pointer);
    EXPECT_THAT(fault([&] { baked(scene); }), HasSubstr(reason));
  }
}

TEST(GltfExtensions, PointersToWhatMovesNoVertexAreNamed) {
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 1}, scene.vectors({0, 0, 0, 1, 0, 0}));
  scene.animate(0, "scale", {0, 1}, scene.scalars({0, 1}));
  json& target = scene.document["animations"][1]["channels"][0]["target"];
  target = {{"path", "pointer"},
            {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/alphaCutoff"}}}}}};
  std::vector<std::string> notes;
  GltfOptions options = once_a_second();
  options.note = [&](const std::string& text) { notes.push_back(text); };
  EXPECT_EQ(baked(scene, options).frame(1)[0], 1);
  EXPECT_THAT(notes, testing::Contains(HasSubstr("not kept: animation of /materials")));
}

TEST(GltfExtensions, HalfFloatsAreFloats) {
  GltfScene scene = triangle_scene();
  // 1, -2, 65504; 1/3 rounded, the smallest normal and subnormal; zeros.
  const size_t halves = scene.accessor(
      std::vector<uint16_t>{0x3C00, 0xC000, 0x7BFF, 0x3555, 0x0400, 0x0001, 0, 0x8000, 0}, "VEC3",
      5131, 3);
  scene.primitive()["attributes"]["POSITION"] = halves;
  scene.document["extensionsRequired"] = {"KHR_accessor_float16"};
  EXPECT_THAT(baked(scene).positions,
              ElementsAre(1, -2, 65504, 0.333251953125F, std::ldexp(1.0F, -14),
                          std::ldexp(1.0F, -24), 0, 0, 0));
  scene.primitive()["attributes"]["POSITION"] =
      scene.accessor(std::vector<uint16_t>{0x7C00, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 5131, 3);
  EXPECT_THAT(fault([&] { baked(scene); }), HasSubstr("is not finite"));
}

TEST(GltfExtensions, TexturesMoveTheirCoordinatesWhereTheOutputCannot) {
  GltfScene scene = triangle_scene();
  scene.primitive()["attributes"]["TEXCOORD_0"] =
      scene.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 5126, 2);
  scene.primitive()["material"] = 0;
  scene.document["textures"] = json::array({json::object()});
  json& texture = scene.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture = {{"index", 0},
             {"extensions", {{"KHR_texture_transform", {{"offset", {3, -1}}, {"scale", {2, 4}}}}}}};
  // glTF (3 -1), (5 -1), (3 3); v points upwards here.
  EXPECT_THAT(baked(scene).attributes.at(0).values, ElementsAre(3, 2, 5, 2, 3, -2));
  // The example of the specification: the lower left quadrant, turned.
  texture["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
  EXPECT_THAT(baked(scene).attributes.at(0).values,
              Pointwise(FloatNear(kNear), std::vector<float>{0, 0, 0, 0.5, 0.5, 0}));
  scene.primitive()["targets"] = {
      {{"TEXCOORD_0", scene.accessor(std::vector<float>{1, 0, 0, 0, 0, 0}, "VEC2", 5126, 2)}}};
  scene.document["meshes"][0]["weights"] = {1};
  EXPECT_THAT(baked(scene).attributes.at(0).values,
              Pointwise(FloatNear(kNear), std::vector<float>{0, 0.5, 0, 0.5, 0.5, 0}));
  GltfOptions stays;
  stays.scene_stays = true;
  EXPECT_THAT(baked(scene, stays).attributes.at(0).values,
              Pointwise(FloatNear(kNear), std::vector<float>{1, 1, 1, 1, 0, 0}));
}

TEST(GltfExtensions, PrimitivesWhoseMaterialsMoveCoordinatesDifferentlyShareNoVertices) {
  GltfScene scene = triangle_scene();
  scene.primitive()["attributes"]["TEXCOORD_0"] =
      scene.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 5126, 2);
  scene.document["textures"] = json::array({json::object()});
  for (const double offset : {1, 2}) {
    json material;
    material["pbrMetallicRoughness"]["baseColorTexture"] = {
        {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {offset, 0}}}}}}};
    scene.document["materials"].push_back(material);
  }
  json& primitives = scene.document["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[0]["material"] = 0;
  primitives[1]["material"] = 1;
  EXPECT_THAT(baked(scene).attributes.at(0).values,
              ElementsAre(1, 1, 2, 1, 1, 0, 2, 1, 3, 1, 2, 0));
  primitives[1]["material"] = 0;
  EXPECT_EQ(baked(scene).vertex_count, 3U);
}

/// Made by gltfpack 1.3 with -cz -kv, of a plate of 5 x 5 vertices at whole numbers with colours x/4, y/4, 1 and a
/// target that lifts them by x y / 4: vertex codec of version 1, filters OCTAHEDRAL and COLOR.
TEST(GltfExtensions, MeshoptCompressionOfKhronosIsRead) {
  std::string bytes;
  read_file(std::string(ANICODEC_SOURCE_DIR) + "/tests/fuzz/seeds/gltf/meshopt_khr.glb", bytes);
  MeshSequence s;
  try {
    s = parse_gltf(bytes, "meshopt_khr.glb", {}, once_a_second());
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::kUnsupported)
      GTEST_SKIP() << e.what();
    throw;
  }
  ASSERT_EQ(s.vertex_count, 25U);
  EXPECT_EQ(s.polygons.size(), 32U);
  const Attribute& colours = s.attributes.at(0);
  const Attribute& normals = s.attributes.at(1);
  std::set<std::pair<int, int>> places;
  for (size_t v = 0; v < 25; ++v) {
    const float *flat = s.frame(0).data() + 3 * v, *lifted = s.frame(1).data() + 3 * v;
    const float x = std::round(flat[0]), y = std::round(flat[1]);
    places.emplace(static_cast<int>(x), static_cast<int>(y));
    EXPECT_THAT(std::span(flat, 3), Pointwise(FloatNear(1e-3F), std::vector<float>{x, y, 0.0F}));
    EXPECT_THAT(std::span(lifted, 3),
                Pointwise(FloatNear(1e-3F), std::vector<float>{x, y, x * y / 4}));
    EXPECT_THAT(std::span(colours.values).subspan(4 * v, 4),
                Pointwise(FloatNear(0.01F), std::vector<float>{x / 4, y / 4, 1.0F, 1.0F}));
    EXPECT_THAT(std::span(normals.values).subspan(3 * v, 3),
                Pointwise(FloatNear(0.01F), std::vector<float>{0.0F, 0.0F, 1.0F}));
  }
  EXPECT_EQ(places.size(), 25U);
}

TEST(GltfExtensions, NodesWithoutNamesArePartsWhereThereAreSeveral) {
  GltfScene scene = triangle_scene();
  scene.document["nodes"][0].erase("name");
  scene.document["meshes"][0].erase("name");
  EXPECT_THAT(baked(scene).parts.names, IsEmpty());
  scene.document["nodes"].push_back({{"mesh", 0}, {"translation", {9, 0, 0}}});
  scene.document["scenes"][0]["nodes"] = {0, 1};
  EXPECT_THAT(baked(scene).parts.names, ElementsAre("node 0", "node 1"));
  EXPECT_EQ(split_parts(baked(scene)).meshes.size(), 2U);
  scene.document["nodes"][1]["name"] = "second";
  EXPECT_THAT(baked(scene).parts.names, ElementsAre("second"));
  EXPECT_THAT(baked(scene).parts.of_polygon, ElementsAre(kNoLabel, 0U));
}

TEST(GltfExtensions, FacesOfWhatHasNoNormalsAreFlat) {
  GltfScene scene = triangle_scene();
  scene.primitive()["attributes"]["POSITION"] = scene.vectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  scene.primitive()["indices"] = scene.indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  const MeshSequence flat = baked(scene);
  ASSERT_EQ(flat.shared_normals.size(), 12U);
  EXPECT_EQ(std::set<uint32_t>(flat.shared_normals.begin(), flat.shared_normals.end()).size(), 12U);
  GltfOptions other;
  other.flat_without_normals = false;
  EXPECT_THAT(baked(scene, other).shared_normals, IsEmpty());

  // As a GLB again it has no normals and no more vertices.
  GlbOutput output(flat, false);
  output.add_frame(flat.positions, flat.attributes);
  const std::vector<float> times{0};
  const std::string glb = output.finish(times);
  EXPECT_EQ(glb.find("NORMAL"), std::string::npos);
  const MeshSequence again = parse_gltf(glb, "b.glb", {}, {});
  EXPECT_EQ(again.vertex_count, 4U);
  EXPECT_EQ(again.shared_normals.size(), 12U);

  // Beside it a smooth one.
  json& primitives = scene.document["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["attributes"]["NORMAL"] = scene.vectors({-1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  const MeshSequence both = baked(scene);
  ASSERT_EQ(both.shared_normals.size(), 24U);
  std::set<std::pair<uint32_t, uint32_t>> normals;  // vertex, number
  for (size_t c = 0; c < 24; ++c)
    normals.emplace(both.polygons.corners[c], both.shared_normals[c]);
  EXPECT_EQ(normals.size(), 12U + 4U);
}

TEST(GltfExtensions, FramesBetweenKeysThatAreFarApartStandWhereTheMotionChanges) {
  const float half = std::sqrt(0.5F);
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 600}, scene.vectors({0, 0, 0, 6, 0, 0}));
  MeshSequence s = baked(scene);
  EXPECT_EQ(s.frame_count, 2U) << "straight at even speed";
  EXPECT_EQ(s.rate.value(), 1 / 600.0);
  EXPECT_EQ(s.frame(1)[0], 6);

  // 1 s of motion every 1/30 s in a clip of a minute.
  std::vector<float> times, values;
  for (int k = 0; k <= 30; ++k) {
    times.push_back(static_cast<float>(k) / 30);
    values.insert(values.end(), {static_cast<float>(k * k), 0, 0});
  }
  times.push_back(60);
  values.insert(values.end(), {900, 0, 0});
  scene = triangle_scene();
  scene.animate(0, "translation", times, scene.vectors(values));
  s = baked(scene);
  EXPECT_EQ(s.frame_count, 32U);
  EXPECT_NEAR(s.times.at(31), 60, 1e-6);
  EXPECT_NEAR(s.times.at(7), 7 / 30.0, 1e-6);
  GltfOptions clock;
  clock.rate = FrameRate{30, 1, false};
  EXPECT_EQ(baked(scene, clock).frame_count, 1801U);

  // A quarter of a turn: between frames the straight way is within 1e-5 of the size.
  scene = triangle_scene();
  scene.animate(0, "rotation", {0, 60}, scene.quads({0, 0, 0, 1, 0, 0, half, half}));
  s = baked(scene);
  EXPECT_GT(s.frame_count, 30U);
  EXPECT_LT(s.frame_count, 400U);
  for (uint32_t f = 1; f < s.frame_count; ++f) {
    const double from = s.times.empty() ? (f - 1) / s.rate.value() : s.times[f - 1];
    const double to = s.times.empty() ? f / s.rate.value() : s.times[f];
    const double angle = (from + to) / 2 / 60 * std::numbers::pi / 2;
    EXPECT_NEAR((s.frame(f - 1)[3] + s.frame(f)[3]) / 2, std::cos(angle), 4e-5);
    EXPECT_NEAR((s.frame(f - 1)[4] + s.frame(f)[4]) / 2, std::sin(angle), 4e-5);
  }
  // A step stays one.
  scene = triangle_scene();
  scene.animate(0, "translation", {0, 40, 60}, scene.vectors({0, 0, 0, 5, 0, 0, 5, 0, 0}), "STEP");
  s = baked(scene);
  EXPECT_LT(s.frame_count, 40U);
  for (uint32_t f = 0; f < s.frame_count; ++f)
    EXPECT_EQ(s.frame(f)[0], s.times.at(f) < 40 - 1e-6 ? 0 : 5) << f;
  EXPECT_TRUE(std::ranges::any_of(s.times, [](double t) { return t > 39.95 && t < 39.999; }));
}

}  // namespace
}  // namespace anicodec::tools
