// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/tools/command_testing.h"
#include "tests/tools/textures/shown_textures.h"
#include "tools/io/write_sequence.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

class ExportVatCommand : public testing::Test {
 protected:
  ExportVatCommand() {
    MeshSequence clip = limb();
    clip.up = UpAxis::kZ;
    clip.metres_per_unit = 0.01;
    clip.loop = true;
    write_sequence(folder_ / "limb.pc2", clip);
    EXPECT_EQ(anicodec({"encode", folder_ / "limb.obj", folder_ / "limb.pc2", "-o",
                        folder_ / "limb.anic", "--rmse", "0.1%", "--up", "z", "--unit", "cm", "-q"})
                  .status,
              0);
  }

  Outcome export_vat(std::vector<std::string> options) {
    std::vector<std::string> arguments = {"export-vat", folder_ / "limb.anic", "-o",
                                          folder_ / "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return anicodec(arguments);
  }

  bool has(const std::string& name) { return std::filesystem::exists(folder_ / ("out/" + name)); }

  TemporaryFolder folder_;
};

TEST_F(ExportVatCommand, WritesABasisWithShaders) {
  const Outcome outcome = export_vat({"--shaders", "godot,three"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  for (const char* name : {"limb_basis.exr", "limb_weights.exr", "limb_basis.json", "limb.glb",
                           "anicodec_basis.gdshader", "anicodec_basis.js"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_FALSE(has("AnicodecBasis.hlsl"));
  EXPECT_THAT(outcome.out, HasSubstr("limb_basis.exr: "));
  EXPECT_THAT(outcome.out, HasSubstr("times as much"));
  EXPECT_THAT(outcome.out, HasSubstr("error: largest "));
  EXPECT_THAT(outcome.out, HasSubstr("error of normals: largest "));
  EXPECT_THAT(outcome.err, Not(HasSubstr("left out")));
  EXPECT_EQ(export_vat({"--shaders", "godot,three"}).status, 1) << "overwritten without -f";
}

TEST_F(ExportVatCommand, TurnsAndScales) {
  ASSERT_EQ(export_vat({"--json"}).status, 0);
  const auto box = nlohmann::json::parse(folder_.read("out/limb_basis.json"))["box"];
  const MeshSequence clip = limb();
  float least = clip.positions[2], most = least;
  for (size_t i = 2; i < clip.positions.size(); i += 3) {
    least = std::min(least, clip.positions[i]);
    most = std::max(most, clip.positions[i]);
  }
  EXPECT_NEAR(box["min"][1].get<double>(), double{least} / 100, 0.02 * double{most - least} / 100);
  EXPECT_NEAR(box["max"][1].get<double>(), double{most} / 100, 0.02 * double{most - least} / 100);
}

TEST_F(ExportVatCommand, TakesLengthsInTheirUnit) {
  EXPECT_LE(export_vat({"--json", "--rmse", "2mm"}).json()["rmse"], 0.002);
}

TEST_F(ExportVatCommand, LoopsLeaveOutARepeatedFrame) {
  MeshSequence clip = limb();
  std::ranges::copy(clip.frame(0), clip.frame(clip.frame_count - 1).begin());
  write_sequence(folder_ / "limb.pc2", clip, {.overwrite = true});
  for (const auto& [options, frames] :
       {std::pair{std::vector<std::string>{}, 12}, {{"--loop"}, 11}}) {
    std::vector<std::string> encode = {"encode",
                                       folder_ / "limb.obj",
                                       folder_ / "limb.pc2",
                                       "-o",
                                       folder_ / "limb.anic",
                                       "--lossless",
                                       "-q",
                                       "-f"};
    encode.insert(encode.end(), options.begin(), options.end());
    ASSERT_EQ(anicodec(encode).status, 0);
    ASSERT_EQ(export_vat({"-f"}).status, 0);
    const auto json = nlohmann::json::parse(folder_.read("out/limb_basis.json"));
    EXPECT_EQ(json["clips"][0]["frame_count"], frames);
    EXPECT_EQ(json["clips"][0]["loop"], !options.empty());
    EXPECT_EQ(json["frames"], 12);
  }
}

TEST_F(ExportVatCommand, TellsAsJson) {
  const nlohmann::json json =
      export_vat({"--form", "houdini", "--image", "png", "--json", "--frames", "::3"}).json();
  EXPECT_EQ(json["form"], "houdini");
  EXPECT_EQ(json["frames"], 4);
  EXPECT_EQ(json["vertices"], json["files"][0]["width"]);
  EXPECT_EQ(json["files"][0]["file"], "limb_pos.png");
  EXPECT_EQ(json["files"][0]["bytes"], std::filesystem::file_size(folder_ / "out/limb_pos.png"));
  EXPECT_LT(json["rmse"], 1e-3);
  EXPECT_GT(json["rms_normal_error"], 0);
  EXPECT_TRUE(json["left_out"].empty());
  EXPECT_TRUE(has("limb_rot.png"));
}

TEST_F(ExportVatCommand, NamesWhatIsLeftOut) {
  MeshSequence clip = limb();
  clip.origin = {1000, 2000, 3000};
  Attribute heat;
  heat.kind = AttributeKind::kCustom;
  heat.name = "heat";
  heat.components = 1;
  heat.values.assign(clip.vertex_count, 0.5F);
  clip.attributes.push_back(heat);
  write_sequence(folder_ / "f_%02d.ply", clip);
  ASSERT_EQ(anicodec({"encode", folder_ / "f_*.ply", "-o", folder_ / "limb.anic", "-q", "-f",
                      "--rmse", "0.1%"})
                .status,
            0);
  const Outcome outcome = export_vat({"--form", "openvat"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_THAT(outcome.err, HasSubstr("left out: the custom attribute 'heat'"));
  EXPECT_TRUE(has("limb_vat.exr"));
}

TEST_F(ExportVatCommand, RefusesWhatCannotBe) {
  EXPECT_EQ(export_vat({"--form", "openvat", "--rmse", "1%"}).status, 1);
  EXPECT_EQ(export_vat({"--shaders", "quake"}).status, 1);
  EXPECT_EQ(export_vat({"--max-size", "8"}).status, 1);
  const Outcome large = export_vat({"--form", "openvat", "--max-size", "16"});
  EXPECT_EQ(large.status, 2);
  EXPECT_THAT(large.err, HasSubstr("and 16 are the most"));
  EXPECT_FALSE(has("limb_vat.exr"));
}

}  // namespace
}  // namespace anicodec::tools
