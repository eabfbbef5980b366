// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Attributes, from file to file by the command.
#include "corpus/clips.h"
#include "tests/tools/clip_testing.h"
#include "tests/tools/command_testing.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

class AttributesOfFiles : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(anicodec({"corpus", "painted_box", "-o", folder_ / "a.pc2"}).status, 0);
    ASSERT_EQ(
        anicodec({"encode", folder_ / "a.pc2", "-o", folder_ / "a.anic", "--order", "all"}).status,
        0);
  }

  /// The look of the first material, less what MTL has no statement for: the cache's mesh is an OBJ.
  MaterialLook wood() const {
    MaterialLook look = source_.materials.looks[0];
    look.alpha = AlphaMode::kBlend;
    look.alpha_cutoff = 0.5F;
    look.double_sided = false;
    return look;
  }

  TemporaryFolder folder_;
  MeshSequence source_ = corpus::make_clip("painted_box");
};

TEST_F(AttributesOfFiles, AreSaidByInfo) {
  const nlohmann::json list = anicodec({"info", folder_ / "a.anic", "--json"}).json()["attributes"];
  ASSERT_EQ(list.size(), 5U);
  EXPECT_EQ(list[0]["kind"], "uv");
  EXPECT_EQ(list[0]["of"], "corners");
  EXPECT_EQ(list[1]["kind"], "normal");
  EXPECT_EQ(list[1]["components"], 0);
  EXPECT_EQ(list[2]["kind"], "colour");
  EXPECT_EQ(list[3]["labels"], (nlohmann::json{"wood", "metal"}));
  EXPECT_EQ(list[4]["kind"], "part");
  EXPECT_THAT(anicodec({"info", folder_ / "a.anic"}).out,
              HasSubstr("normal of corners: hard edges"));
  EXPECT_THAT(anicodec({"dump", folder_ / "a.anic"}).out, HasSubstr("ATTR attribute 3 label 1"));
}

TEST_F(AttributesOfFiles, ComeBackAsObj) {
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "b_%03d.obj"}).status, 0);
  const MeshSequence back = load_file(folder_ / "b_*.obj");
  ASSERT_EQ(back.polygons, source_.polygons);
  EXPECT_EQ(back.materials.names, source_.materials.names);
  EXPECT_EQ(back.materials.of_polygon, source_.materials.of_polygon);
  ASSERT_EQ(back.materials.looks.size(), 2U);
  EXPECT_EQ(back.materials.looks[0], wood());
  EXPECT_FALSE(back.materials.looks[1].known);
  EXPECT_EQ(back.parts, source_.parts);
  const Attribute *uv = find_attribute(back, AttributeKind::kUv),
                  *colour = find_attribute(back, AttributeKind::kColour);
  ASSERT_TRUE(uv && colour);
  EXPECT_EQ(uv->values, source_.attributes[0].values);  // multiples of the step
  EXPECT_EQ(colour->values, source_.attributes[1].values);
  // Normals of one side of the box differ from those of the others.
  const Attribute* normals = find_attribute(back, AttributeKind::kNormal);
  ASSERT_TRUE(normals);
  std::set<std::vector<float>> distinct;
  for (size_t i = 0; i < normals->values.size(); i += 3)
    distinct.insert({normals->values.begin() + static_cast<ptrdiff_t>(i),
                     normals->values.begin() + static_cast<ptrdiff_t>(i + 3)});
  EXPECT_GT(distinct.size(), 6U);
  // And what was read from them is the same hard edges again.
  ASSERT_EQ(
      anicodec({"encode", folder_ / "b_*.obj", "-o", folder_ / "c.anic", "--order", "all"}).status,
      0);
  EXPECT_EQ(anicodec({"info", folder_ / "c.anic", "--json"}).json()["attributes"].size(), 5U);
}

TEST_F(AttributesOfFiles, ComeBackAsGlb) {
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "b.glb"}).status, 0);
  const MeshSequence back = load_file(folder_ / "b.glb");
  EXPECT_EQ(back.frame_count, source_.frame_count);
  EXPECT_EQ(back.vertex_count, 6U * 25);  // every side for itself
  const Attribute *uv = find_attribute(back, AttributeKind::kUv),
                  *normals = find_attribute(back, AttributeKind::kNormal);
  ASSERT_TRUE(uv && normals && find_attribute(back, AttributeKind::kColour));
  std::set<std::pair<float, float>> here, there;
  for (size_t i = 0; i < uv->values.size(); i += 2)
    here.insert({uv->values[i], uv->values[i + 1]});
  const FrameArray& source = source_.attributes[0].values;
  for (size_t i = 0; i < source.size(); i += 2)
    there.insert({source[i], source[i + 1]});
  EXPECT_EQ(here, there);
  EXPECT_EQ(back.materials.names, source_.materials.names);
  ASSERT_EQ(back.materials.looks.size(), 2U);
  EXPECT_EQ(back.materials.looks[0], wood());
  EXPECT_EQ(back.materials.looks[1].metallic, 0);
}

TEST_F(AttributesOfFiles, TakeImagesFromASceneThatIsNamed) {
  // A scene with an image inside, which its material names.
  const std::string scene = folder_.write("s.gltf", R"({"asset": {"version": "2.0"},
    "images": [{"uri": "data:image/png;base64,iVBORw==", "name": "grain"}],
    "textures": [{"source": 0}],
    "materials": [{"name": "wood", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
    "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0, "cameras": [{"type": "perspective",
    "perspective": {"yfov": 1, "znear": 1}}]})");
  const Outcome encoded = anicodec({"encode", scene, "-o", folder_ / "s.anic"});
  ASSERT_EQ(encoded.status, 0) << encoded.err;
  EXPECT_THAT(encoded.err + encoded.out, HasSubstr("not kept: 1 camera, 1 image inside the scene"));
  const auto image_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"decode", folder_ / "s.anic", "-f", "-o", folder_ / "t.glb"});
    EXPECT_EQ(anicodec(arguments).status, 0);
    return load_file(folder_ / "t.glb").materials.looks.at(0).texture(TextureSlot::kBaseColour);
  };
  EXPECT_EQ(image_of({}), "");
  EXPECT_EQ(image_of({"--textures", scene}), "#grain");
  EXPECT_NE(
      anicodec({"decode", folder_ / "s.anic", "-f", "-o", folder_ / "t.obj", "--textures", scene})
          .status,
      0);
}

TEST_F(AttributesOfFiles, AreLeftOutWhereAsked) {
  ASSERT_EQ(
      anicodec({"encode", folder_ / "a.pc2", "-o", folder_ / "b.anic", "--no-attributes"}).status,
      0);
  EXPECT_TRUE(anicodec({"info", folder_ / "b.anic", "--json"}).json()["attributes"].empty());
}

TEST_F(AttributesOfFiles, FollowPartsThatAreJoined) {
  for (const char* range : {"0:10", "10:24"})
    ASSERT_EQ(anicodec({"encode", folder_ / "a.pc2", "-o",
                        folder_ / (std::string(range, 2) + ".anic"), "--part", range})
                  .status,
              0);
  ASSERT_EQ(
      anicodec({"join", folder_ / "0:.anic", folder_ / "10.anic", "-o", folder_ / "j.anic"}).status,
      0);
  EXPECT_EQ(anicodec({"info", folder_ / "j.anic", "--json"}).json()["attributes"].size(), 5U);
}

/// Frames with colours, a temperature and texture coordinates that change.
class AttributesThatMove : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(anicodec({"corpus", "heated", "-o", folder_ / "a_%03d.ply"}).status, 0);
    encoded_ = anicodec({"encode", folder_ / "a_*.ply", "-o", folder_ / "a.anic", "--kg", "0.5",
                         "--effort", "fast", "--fps", "24"});
    ASSERT_EQ(encoded_.status, 0) << encoded_.err;
  }

  TemporaryFolder folder_;
  Outcome encoded_;
  MeshSequence source_ = corpus::make_clip("heated");
};

TEST_F(AttributesThatMove, AreReadFromPlyAndSaidByInfoAndEncode) {
  const MeshSequence read = load_file(folder_ / "a_*.ply");
  ASSERT_EQ(read.attributes.size(), 3U);
  const Attribute *colour = find_attribute(read, AttributeKind::kColour),
                  *heat = find_attribute(read, AttributeKind::kCustom),
                  *uv = find_attribute(read, AttributeKind::kUv);
  ASSERT_TRUE(colour && heat && uv);
  EXPECT_EQ(colour->frames, source_.frame_count);
  EXPECT_EQ(colour->values, source_.attributes[1].values);
  EXPECT_EQ(heat->name, "temperature");
  EXPECT_EQ(heat->values, source_.attributes[2].values);
  EXPECT_EQ(uv->values, source_.attributes[0].values);
  EXPECT_THAT(encoded_.out, HasSubstr("custom \"temperature\": "));
  const nlohmann::json list = anicodec({"info", folder_ / "a.anic", "--json"}).json()["attributes"];
  ASSERT_EQ(list.size(), 3U);
  for (const nlohmann::json& a : list) {
    EXPECT_EQ(a["moves"], true);
    EXPECT_GT(a["bytes"], 0);
    EXPECT_GT(a["max_error"], 0);
  }
  EXPECT_THAT(anicodec({"info", folder_ / "a.anic"}).out, HasSubstr("moves, "));
  EXPECT_THAT(anicodec({"dump", folder_ / "a.anic"}).out, HasSubstr("of an attribute"));
}

TEST_F(AttributesThatMove, ComeBackAsPlyAsciiAndBinary) {
  for (const char* format : {"--ascii", "--quiet"}) {
    ASSERT_EQ(
        anicodec({"decode", folder_ / "a.anic", "-f", "-o", folder_ / "b_%03d.ply", format}).status,
        0);
    const MeshSequence back = load_file(folder_ / "b_*.ply");
    ASSERT_EQ(back.attributes.size(), 3U);
    EXPECT_EQ(find_attribute(back, AttributeKind::kColour)->values,
              source_.attributes[1].values);  // bytes
    const FrameArray& heat = find_attribute(back, AttributeKind::kCustom)->values;
    for (size_t i = 0; i < heat.size(); ++i)
      ASSERT_NEAR(heat[i], source_.attributes[2].values[i], 0.46);
  }
}

TEST_F(AttributesThatMove, ComeBackAsObjAndGlb) {
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "b_%03d.obj"}).status, 0);
  const MeshSequence obj = load_file(folder_ / "b_*.obj");
  const Attribute* colour = find_attribute(obj, AttributeKind::kColour);
  ASSERT_TRUE(colour);
  EXPECT_EQ(colour->frames, source_.frame_count);
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "b.glb"}).status, 0);
  const MeshSequence glb = load_file(folder_ / "b.glb");
  const FrameArray& source = source_.attributes[1].values;
  ASSERT_EQ(glb.frame_count, source_.frame_count);
  for (const MeshSequence* back : {&obj, &glb}) {
    const Attribute* rgb = find_attribute(*back, AttributeKind::kColour);
    ASSERT_TRUE(rgb);
    ASSERT_EQ(rgb->frames, source_.frame_count);
    const size_t n = rgb->components, count = rgb->values.size() / n;
    ASSERT_EQ(count, source.size() / 4);
    for (size_t i = 0; i < count; ++i) {
      for (size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(rgb->values[n * i + c], source[4 * i + c], 0.5 / 255 + 1e-5);
    }
  }
  const Attribute* uv = find_attribute(glb, AttributeKind::kUv);
  ASSERT_TRUE(uv);
  ASSERT_EQ(uv->values.size(), source_.attributes[0].values.size());
  for (size_t i = 0; i < uv->values.size(); ++i)
    ASSERT_NEAR(uv->values[i], source_.attributes[0].values[i], 0.0015);
}

TEST_F(AttributesThatMove, AreComparedByName) {
  const nlohmann::json list =
      anicodec({"compare", folder_ / "a_*.ply", folder_ / "a.anic", "--json", "--no-sted"})
          .json()["attributes"];
  ASSERT_EQ(list.size(), 3U);
  for (const nlohmann::json& a : list) {
    EXPECT_GT(a["max_error"], 0);
    EXPECT_LT(a["rmse"], a["max_error"]);
    EXPECT_LT(a["max_error"], a["name"] == "temperature" ? 0.46 : 0.002);
  }
}

TEST_F(AttributesThatMove, HaveTheErrorThatIsAskedFor) {
  const Outcome outcome =
      anicodec({"encode", folder_ / "a_*.ply", "-o", folder_ / "b.anic", "--kg", "0.5", "--effort",
                "fast", "--attribute-error", "2%", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const nlohmann::json& a : outcome.json()["moving_attributes"]) {
    EXPECT_LE(a["max_error"], a["asked"]);
  }
  EXPECT_NE(
      anicodec({"encode", folder_ / "a_*.ply", "-o", folder_ / "c.anic", "--attribute-error", "-1"})
          .status,
      0);
}

TEST_F(AttributesThatMove, HaveBoundsAndUnitsByTheirNames) {
  const Outcome encoded =
      anicodec({"encode", folder_ / "a_*.ply", "-o", folder_ / "b.anic", "--kg", "0.5", "--effort",
                "fast", "--json", "--field-error", "temperature=5%", "--field-unit",
                "temperature=K", "--meta", "author=A"});
  ASSERT_EQ(encoded.status, 0) << encoded.err;
  for (const nlohmann::json& a : encoded.json()["moving_attributes"])
    EXPECT_EQ(a["asked"] > 1, a["name"] == "temperature");
  const nlohmann::json info = anicodec({"info", folder_ / "b.anic", "--json"}).json();
  EXPECT_EQ(info["metadata"]["author"], "A");
  const auto heat = std::ranges::find_if(info["attributes"],
                                         [](const auto& a) { return a["name"] == "temperature"; });
  ASSERT_NE(heat, info["attributes"].end());
  EXPECT_EQ((*heat)["unit"], "K");
  EXPECT_EQ((*heat)["whole"], false);
  const auto [low, high] = std::ranges::minmax(source_.attributes[2].values);
  EXPECT_NEAR((*heat)["ranges"][0][0], low, 25);
  EXPECT_NEAR((*heat)["ranges"][0][1], high, 25);
  EXPECT_THAT(anicodec({"info", folder_ / "b.anic"}).out, HasSubstr(" K\n"));
}

TEST_F(AttributesThatMove, AreChosenByTheirNames) {
  const auto encode = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"encode", folder_ / "a_*.ply", "-o", folder_ / "b.anic", "-f",
                               "--kg", "0.5", "--effort", "fast", "--json"});
    return anicodec(more);
  };
  EXPECT_EQ(encode({"--fields", "temperature"}).json()["moving_attributes"].size(), 3U);
  EXPECT_EQ(encode({"--fields", "none"}).json()["moving_attributes"].size(), 2U);
  EXPECT_THAT(encode({"--fields", "pressure"}).err,
              HasSubstr("--fields: there is no attribute pressure, but "));
  EXPECT_THAT(encode({"--field-error", "pressure=1"}).err, HasSubstr("temperature"));
  EXPECT_THAT(encode({"--field-error", "temperature"}).err,
              HasSubstr("--field-error takes NAME=VALUE, not temperature"));
  EXPECT_THAT(encode({"--field-error", "temperature=exact"}).err, HasSubstr("cannot be exact"));
}

TEST(ObjAttributes, OfCornersThatMoveComeBackInEveryFrame) {
  TemporaryFolder folder;
  const auto frame = [](int f) {
    std::string text;
    for (int v = 0; v < 9; ++v)
      text += "v " + std::to_string(v % 3) + " " + std::to_string(v / 3) + " " +
              std::to_string(0.1 * f * (v % 4)) + "\n";
    for (int v = 0; v < 9; ++v)
      text += "vt " + std::to_string(0.5 * (v % 3) + 0.03 * f) + " " +
              std::to_string(0.5 * (v / 3)) + "\n";
    text += "vt " + std::to_string(1 - 0.05 * f) + " 0.25\n";  // of one corner alone
    text += "f 1/1 2/2 5/5 4/4\nf 2/2 3/3 6/6 5/10\nf 4/4 5/5 8/8 7/7\nf 5/5 6/6 9/9\n";
    return text;
  };
  for (int f = 0; f < 6; ++f)
    folder.write("a_" + std::to_string(f) + ".obj", frame(f));
  const MeshSequence source = load_sequence(std::vector<std::string>{folder / "a_*.obj"});
  ASSERT_EQ(source.attributes[0].frames, 6U);
  const Outcome encoded =
      anicodec({"encode", folder / "a_*.obj", "-o", folder / "a.anic", "--order", "all",
                "--max-error", "0.1%", "--attribute-error", "0.001"});
  ASSERT_EQ(encoded.status, 0) << encoded.err;
  EXPECT_EQ(anicodec({"verify", folder / "a.anic"}).status, 0);
  const nlohmann::json uv = anicodec({"info", folder / "a.anic", "--json"}).json()["attributes"][0];
  EXPECT_EQ(uv["of"], "corners");
  EXPECT_EQ(uv["moves"], true);
  for (const char* output : {"b_%01d.obj", "b.abc"}) {
    ASSERT_EQ(anicodec({"decode", folder / "a.anic", "-o", folder / output}).status, 0);
    const MeshSequence back = load_sequence(
        std::vector<std::string>{folder / (std::string(output) == "b.abc" ? "b.abc" : "b_*.obj")});
    const Attribute* moved = find_attribute(back, AttributeKind::kUv);
    ASSERT_TRUE(moved);
    ASSERT_EQ(moved->frames, 6U);
    ASSERT_EQ(moved->values.size(), source.attributes[0].values.size());
    for (size_t i = 0; i < moved->values.size(); ++i)
      ASSERT_NEAR(moved->values[i], source.attributes[0].values[i], 0.001) << output << " " << i;
  }
}

TEST(ObjAttributes, WithoutTheirNumbersAreRefused) {
  TemporaryFolder folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n";
  auto fails = [&](const std::string& face, const std::string& reason) {
    folder.write("a.obj", mesh + face);
    const Outcome outcome = anicodec({"encode", folder / "a.obj", "-o", folder / "a.anic"});
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr(reason));
  };
  fails("f 1/1 2/2 3/3\n", "face 0 uses uv 3, but there are 2");
  fails("f 1/1 2/2 3/-3\n", "uv -3 is out of range");
  fails("vn 0 1\nf 1 2 3\n", "normal of 2 numbers");
}

}  // namespace
}  // namespace anicodec::tools
