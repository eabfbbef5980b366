// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Scenes through the command: GLB in, out, and what the Khronos validator says about it.
#include "corpus/clips.h"
#include "tests/real_data.h"
#include "tests/tools/clip_testing.h"
#include "tests/tools/command_testing.h"
#include "tests/tools/gltf_testing.h"
#include "tests/two_boxes.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

TEST(GltfCommand, EncodesAndDecodesScenes) {
  TemporaryFolder folder;
  write_sequence(folder / "a.glb", corpus::make_clip("limb"));
  Outcome encoded =
      anicodec({"encode", folder / "a.glb", "-o", folder / "a.anic", "--order", "vertices"});
  ASSERT_EQ(encoded.status, 0) << encoded;
  ASSERT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / "b.glb"}).status, 0);
  Outcome compared =
      anicodec({"compare", folder / "a.glb", folder / "b.glb", "--no-sted", "--json"});
  ASSERT_EQ(compared.status, 0) << compared;
  EXPECT_LE(compared.json()["max_error_percent"], 0.0501);
  ASSERT_EQ(
      anicodec({"decode", folder / "a.anic", "-o", folder / "one.glb", "--frames", "3"}).status, 0);
  EXPECT_EQ(load_file(folder / "one.glb").frame_count, 1U);
  EXPECT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / "b.gltf"}).status, 1);
}

TEST(GltfCommand, LeavesTheOrderOfVerticesOutUnlessAskedForIt) {
  TemporaryFolder folder;
  write_sequence(folder / "a.glb", corpus::make_clip("limb"));
  write_sequence(folder / "a.pc2", corpus::make_clip("limb"));
  const auto order_of = [&](const std::vector<std::string>& inputs) {
    std::vector<std::string> arguments{"encode", "-f", "-q", "-o", folder / "a.anic"};
    arguments.insert(arguments.end(), inputs.begin(), inputs.end());
    const Outcome encoded = anicodec(arguments);
    EXPECT_EQ(encoded.status, 0) << encoded;
    return anicodec({"info", folder / "a.anic", "--json"}).json()["order"].get<std::string>();
  };
  EXPECT_EQ(order_of({folder / "a.glb"}), "free");
  EXPECT_EQ(order_of({folder / "a.glb", "--order", "vertices"}), "vertices");
  EXPECT_EQ(order_of({folder / "a.obj", folder / "a.pc2"}), "vertices");
  EXPECT_EQ(order_of({folder / "a.obj", folder / "a.pc2", "--order", "free"}), "free");
}

TEST(GltfCommand, PutsTheClipIntoTheScene) {
  TemporaryFolder folder;
  write_sequence(folder / "a.glb", gltf_limb());
  const Outcome encoded =
      anicodec({"encode", folder / "a.glb", "-o", folder / "b.glb", "--json", "--effort", "fast"});
  ASSERT_EQ(encoded.status, 0) << encoded;
  EXPECT_EQ(encoded.json()["glb_bytes"], std::filesystem::file_size(folder / "b.glb"));
  EXPECT_EQ(anicodec({"verify", folder / "b.glb"}).status, 0);
  EXPECT_EQ(anicodec({"info", folder / "b.glb", "--json"}).json()["order"], "vertices");
  ASSERT_EQ(anicodec({"decode", folder / "b.glb", "-o", folder / "c.glb"}).status, 0);
  const Outcome compared =
      anicodec({"compare", folder / "a.glb", folder / "c.glb", "--no-sted", "--json"});
  ASSERT_EQ(compared.status, 0) << compared;
  EXPECT_LE(compared.json()["max_error_percent"], 0.0501);
  EXPECT_EQ(load_file(folder / "b.glb").frame_count, 1U);  // what others see
  EXPECT_THAT(anicodec({"encode", folder / "b.glb", "-o", folder / "b.anic"}).err,
              HasSubstr("b.glb moves by a clip inside"));
  for (const char* option : {"--split-objects", "--part=0:2", "--order=free"})
    EXPECT_EQ(anicodec({"encode", folder / "a.glb", "-o", folder / "d.glb", option}).status, 1);
  write_sequence(folder / "a.pc2", gltf_limb());
  EXPECT_EQ(anicodec({"encode", folder / "a.pc2", "-o", folder / "d.glb"}).status, 1);
}

TEST(GltfCommand, WritesAnAnimationForEachClip) {
  TemporaryFolder folder;
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {1, 2}, scene.vectors({0, 0, 0, 5, 0, 0}), "LINEAR", "short");
  scene.animate(0, "translation", {0, 2}, scene.vectors({0, 0, 0, 0, 5, 0}), "LINEAR", "long");
  folder.write("a.glb", scene.glb());
  ASSERT_EQ(anicodec({"encode", folder / "a.glb", "--clips", "all", "--fps", "10", "-o",
                      folder / "a.anic"})
                .status,
            0);
  const Outcome decoded = anicodec({"decode", folder / "a.anic", "-o", folder / "b.glb"});
  ASSERT_EQ(decoded.status, 0) << decoded;
  for (const auto& [name, frames, start] :
       {std::tuple("short", 11U, 1.0), std::tuple("long", 21U, 0.0)}) {
    const std::vector<std::string> one{folder / "b.glb"};
    const MeshSequence clip = load_sequence(one, {.clip = name});
    EXPECT_EQ(clip.frame_count, frames);
    EXPECT_NEAR(clip.start_time, start, 1e-6);
    EXPECT_NEAR(clip.frame(frames - 1)[name == std::string("short") ? 0 : 1], 5, 0.05);
  }
  ASSERT_EQ(
      anicodec({"decode", folder / "a.anic", "-o", folder / "c.glb", "--clip", "long"}).status, 0);
  EXPECT_EQ(load_file(folder / "c.glb").frame_count, 21U);
  EXPECT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / "c.pc2"}).status, 1);  // which?
}

TEST(GltfCommand, AnalyzesAnAnimationAtARate) {
  TemporaryFolder folder;
  GltfScene scene = triangle_scene();
  scene.animate(0, "translation", {0, 1}, scene.vectors({0, 0, 0, 5, 0, 0}), "LINEAR", "short");
  scene.animate(0, "translation", {0, 2}, scene.vectors({0, 0, 0, 0, 5, 0}), "LINEAR", "long");
  folder.write("a.glb", scene.glb());
  Outcome outcome = anicodec({"analyze", folder / "a.glb", "--clip", "long", "--fps", "10",
                              "--counts", "1", "--effort", "fast", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_EQ(outcome.json()["frames"], 21);
  EXPECT_EQ(outcome.json()["frame_rate"], 10);
  EXPECT_EQ(outcome.json()["name"], "a long");
}

TEST(GltfCommand, NamesThePlaceOfAFault) {
  TemporaryFolder folder;
  GltfScene scene = triangle_scene();
  scene.document["nodes"][0]["children"] = {0};
  Outcome outcome =
      anicodec({"encode", folder.write("a.glb", scene.glb()), "-o", folder / "a.anic"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a.glb: /nodes/0: the node is cyclic"));
}

TEST(GltfCommand, TurnsAndCutsWhatItCompares) {
  TemporaryFolder folder;
  MeshSequence clip = corpus::make_clip("limb");
  write_sequence(folder / "y.pc2", clip);
  MeshSequence turned = clip;
  for (size_t i = 0; i < clip.positions.size(); i += 3) {
    turned.positions[i + 1] = -clip.positions[i + 2];
    turned.positions[i + 2] = clip.positions[i + 1];
  }
  write_sequence(folder / "z.pc2", turned);
  auto largest = [&](std::vector<std::string> options) -> double {
    options.insert(options.begin(),
                   {"compare", folder / "y.pc2", folder / "z.pc2", "--no-sted", "--json"});
    Outcome compared = anicodec(options);
    EXPECT_EQ(compared.status, 0) << compared;
    return compared.json()["max_error"];
  };
  EXPECT_GT(largest({}), 0.01);
  EXPECT_EQ(largest({"--axes-b", "x,z,-y"}), 0);
  EXPECT_EQ(largest({"--axes-b", "x,z,-y", "--frames-a", "2:5", "--frames-b", "2:5"}), 0);
  EXPECT_GT(largest({"--axes-b", "x,z,-y", "--frames-a", "0:5", "--frames-b", "2:7"}), 0);
  EXPECT_EQ(anicodec({"compare", folder / "y.pc2", folder / "z.pc2", "--axes-b", "x,y,y"}).status,
            1);
}

// The validator is a package of npm, named in tests/gltf.
TEST(GltfValidator, FindsNothingWrong) {
  const std::string package = ANICODEC_SOURCE_DIR "/tests/gltf";
  if (!std::filesystem::exists(package + "/node_modules/gltf-validator"))
    GTEST_SKIP() << "the glTF validator is absent; npm ci --prefix tests/gltf installs it";
  if (run_program({"node", "--version"}).status != 0)
    GTEST_SKIP() << "node is absent";
  TemporaryFolder folder;
  std::vector<std::string> arguments{"node", package + "/validate.mjs"};
  for (const std::string name : {"limb", "waves", "quad_box", "one_triangle", "boxes"}) {
    MeshSequence clip = name == "boxes" ? two_boxes() : corpus::make_clip(name);
    const std::string base = folder / name;
    write_sequence(base + ".glb", clip);
    write_sequence(base + "_step.glb", clip, {.step = true});
    clip.positions.resize(size_t{3} * clip.vertex_count);
    clip.frame_count = 1;
    clip.up = UpAxis::kZ;
    clip.metres_per_unit = 0.01;
    clip.materials = {{"paint"}, std::vector<uint32_t>(clip.polygons.size(), 0)};
    clip.attributes.push_back({.kind = AttributeKind::kUv,
                               .name = "uv",
                               .components = 2,
                               .values = FrameArray(size_t{2} * clip.vertex_count, 0.5F)});
    write_sequence(base + "_one.glb", clip);
    const Outcome moving =
        anicodec({"encode", base + ".glb", "-o", base + "_moving.glb", "--effort", "fast"});
    EXPECT_EQ(moving.status, 0) << moving;
    arguments.insert(arguments.end(),
                     {base + ".glb", base + "_step.glb", base + "_one.glb", base + "_moving.glb"});
  }
  Outcome outcome = run_program(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome;
}

class RealDataGltf : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(real_data_folder() + "/gltf"))
      GTEST_SKIP() << real_data_folder()
                   << "/gltf is absent; ANICODEC_DATA names the folder of real clips";
  }
};

TEST_P(RealDataGltf, ImportsAndKeepsItsPromise) {
  TemporaryFolder folder;
  const std::string source = real_data_folder() + "/" + GetParam();
  Outcome encoded = anicodec({"encode", source, "-o", folder / "a.anic", "--kg", "1", "--effort",
                              "fast", "--fps", "10", "--order", "vertices", "--json"});
  ASSERT_EQ(encoded.status, 0) << encoded;
  std::vector<std::string> clips;
  const nlohmann::json said = encoded.json();
  for (const auto& clip : said.value("clips", nlohmann::json::array()))
    clips.push_back(clip["name"]);
  if (clips.size() < 2)  // one animation may have no name
    clips.assign(1, "");
  for (const std::string& clip : clips) {
    std::vector<std::string> options = {"compare", source, folder / "a.anic", "--json",
                                        "--no-sted"};
    if (!clip.empty())
      options.insert(options.end(), {"--clip", clip});
    Outcome compared = anicodec(options);
    ASSERT_EQ(compared.status, 0) << compared;
    ASSERT_TRUE(compared.json()["kg"].is_number()) << compared;
    EXPECT_LE(compared.json()["kg"], 1.0) << clip;
  }
}

INSTANTIATE_TEST_SUITE_P(, RealDataGltf,
                         testing::Values("gltf/CesiumMan.glb", "gltf/Fox.glb",
                                         "gltf/MorphStressTest.gltf", "gltf/Tank4.glb",
                                         "gltf/lumberjack.glb", "gltf/raylib_robot.glb",
                                         "gltf/fan/vintageFan_animated.gltf",
                                         "exported/cesium_morph.glb"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

class RealDataCesium : public RealDataGltf {
 protected:
  /// The output of compare for two files of the folder.
  nlohmann::json compared(const std::string& a, const std::string& b,
                          std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"compare", real_data_folder() + "/" + a, real_data_folder() + "/" + b, "--json",
                    "--no-sted", "--mesh", real_data_folder() + "/exported/obj/cesium1.obj"});
    Outcome outcome = anicodec(options);
    EXPECT_EQ(outcome.status, 0) << outcome;
    return outcome.json();
  }
};

// One clip as another program writes it: 48 frames, those of the scene without its first.
TEST_F(RealDataCesium, AgreesWithItsExports) {
  const std::string scene = "gltf/CesiumMan.glb", obj = "exported/obj/*.obj";
  auto baked = compared(obj, scene, {"--frames-b", "1:"});
  EXPECT_EQ(baked["method"], "vertices");
  EXPECT_LT(baked["max_error_percent"], 1e-3);
  EXPECT_EQ(compared("exported/cesium.pc2", "exported/cesium.mdd", {})["max_error"], 0);
  for (const char* cache : {"exported/cesium.pc2", "exported/cesium.mdd"}) {
    EXPECT_LT(compared(obj, cache, {"--axes-b", "x,z,-y"})["max_error_percent"], 1e-3);
    EXPECT_LT(
        compared(cache, scene, {"--frames-b", "1:", "--axes-b", "x,-z,y"})["max_error_percent"],
        1e-3);
  }
  // Its vertices are split at seams: the surfaces are compared. The first key is the rest pose, the
  // last repeats the first.
  const std::string morph = "exported/cesium_morph.glb";
  for (const auto& [other, options] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {obj, {"--axes-b", "x,-z,y"}},
           {scene, {"--fps", "24", "--frames-a", "1:", "--axes-b", "x,-z,y"}},
           {"exported/cesium.pc2", {"--axes-b", "x,-y,-z"}},
           {"exported/cesium.mdd", {"--axes-b", "x,-y,-z"}}}) {
    std::vector<std::string> all = options;
    all.insert(all.end(), {"--frames-b", "1:49"});
    auto surfaces = compared(other, morph, all);
    EXPECT_EQ(surfaces["method"], "surface") << other;
    EXPECT_LT(surfaces["hausdorff_percent"], 1e-3) << other;
  }
}

// Formats that libraries read: frames of a model, and a mesh whose file has neither skin nor
// animation.
TEST_F(RealDataGltf, TakesOtherScenes) {
  for (const auto& [file, frames] :
       {std::pair("other/faerie.md2", 198), {"exported/cesium.fbx", 1}}) {
    TemporaryFolder folder;
    const std::string source = real_data_folder() + "/" + file;
    Outcome encoded = anicodec(
        {"encode", source, "-o", folder / "a.anic", "--kg", "1", "--effort", "fast", "--json"});
    if (encoded.status != 0 && encoded.err.find("this build is without") != std::string::npos)
      GTEST_SKIP() << encoded.err;
    ASSERT_EQ(encoded.status, 0) << encoded;
    EXPECT_EQ(encoded.json()["frames"], frames) << file;
    EXPECT_LE(encoded.json()["kg"], 1.0) << file;
  }
}

}  // namespace
}  // namespace anicodec::tools
