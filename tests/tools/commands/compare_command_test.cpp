// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

/// The clip with every coordinate moved by up to about a hundredth.
MeshSequence disturbed(MeshSequence clip) {
  for (size_t i = 0; i < clip.positions.size(); ++i)
    clip.positions[i] += 0.01F * static_cast<float>(std::sin(static_cast<double>(i)));
  return clip;
}

TEST(CompareCommand, AgreesWithAnIndependentScript) {
  TemporaryFolder folder;
  for (const char* name : {"limb", "rigid", "static"}) {
    MeshSequence clip = corpus::make_clip(name);
    WriteOptions overwrite;
    overwrite.overwrite = true;
    write_sequence(folder / "a.pc2", clip, overwrite);
    write_sequence(folder / "b.pc2", disturbed(clip), overwrite);
    Outcome ours = anicodec({"compare", folder / "a.pc2", folder / "b.pc2", "--json"});
    ASSERT_EQ(ours.status, 0) << ours;
    Outcome theirs = run_program({"python3", ANICODEC_SOURCE_DIR "/tests/scripts/compare.py",
                                  folder / "a.pc2", folder / "b.pc2"});
    ASSERT_EQ(theirs.status, 0) << theirs;
    nlohmann::json a = ours.json(), b = theirs.json();
    auto expect_close = [&](const char* key, const char* script_key) {
      double x = a[key], y = b[script_key];
      EXPECT_NEAR(x, y, 1e-6 * y) << name << " " << key;
    };
    expect_close("kg", "kg_percent");
    expect_close("rmse", "rmse");
    expect_close("max_error", "max_error");
    expect_close("diagonal", "diagonal");
    EXPECT_EQ(a["max_frame"], b["max_frame"]);
    EXPECT_EQ(a["max_vertex"], b["max_vertex"]);
  }
}

TEST(CompareCommand, FindsNoErrorInACopy) {
  TemporaryFolder folder;
  MeshSequence clip = corpus::make_clip("polygons");
  write_sequence(folder / "a.pc2", clip);
  std::filesystem::create_directory(folder / "b");
  write_sequence(folder / "b/f_%d.obj", clip);
  Outcome outcome = anicodec({"compare", folder / "a.pc2", folder / "b/*.obj", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  nlohmann::json json = outcome.json();
  for (const char* key :
       {"kg", "rmse", "max_error", "max_error_percent", "sted", "displacement_error"})
    EXPECT_EQ(json[key], 0) << key;
  EXPECT_TRUE(json["psnr"].is_null());
  EXPECT_EQ(json["vertices"], clip.vertex_count);
  EXPECT_EQ(json["frames"], clip.frame_count);
  EXPECT_EQ(json["note"], "");
}

TEST(CompareCommand, AlwaysHasTheSameKeys) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_scaled("cloth", 300, 4));
  write_sequence(folder / "b.pc2", corpus::make_scaled("cloth", 500, 4));
  ASSERT_EQ(anicodec({"encode", folder / "a.pc2", "-o", folder / "a.anic", "--kg", "1"}).status, 0);
  auto keys = [&](const char* b) {
    nlohmann::json json = anicodec({"compare", folder / "a.pc2", folder / b, "--json"}).json();
    std::vector<std::string> list;
    for (const auto& item : json.items())
      list.push_back(item.key());
    return list;
  };
  std::vector<std::string> vertices = keys("a.anic");
  EXPECT_EQ(vertices, keys("b.pc2"));
  EXPECT_THAT(vertices, testing::IsSupersetOf({"kg", "rmse", "max_error", "max_error_percent",
                                               "bytes", "bpfv", "vertices", "frames"}));
}

TEST(CompareCommand, MeasuresSurfacesOfDifferentConnectivity) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_scaled("cloth", 300, 4));
  write_sequence(folder / "b.pc2", corpus::make_scaled("cloth", 500, 4));
  Outcome outcome = anicodec({"compare", folder / "a.pc2", folder / "b.pc2", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_EQ(outcome.json()["method"], "surface");
  EXPECT_TRUE(outcome.json()["kg"].is_null());
  EXPECT_GT(outcome.json()["hausdorff"], 0);
}

TEST(CompareCommand, SaysWhenOnlyTheFacesDiffer) {
  TemporaryFolder folder;
  MeshSequence clip = corpus::make_clip("quad_box");
  write_sequence(folder / "a.pc2", clip);
  clip.polygons.add(std::vector<uint32_t>{0, 1, 2});
  write_sequence(folder / "b.pc2", clip);
  Outcome outcome = anicodec({"compare", folder / "a.pc2", folder / "b.pc2"});
  EXPECT_EQ(outcome.status, 0) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("the faces differ"));
}

TEST(CompareCommand, TakesTheMeshOfACache) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_clip("limb"));
  std::filesystem::rename(folder / "a.obj", folder / "mesh.obj");
  EXPECT_EQ(anicodec({"compare", folder / "a.pc2", folder / "a.pc2"}).status, 2);
  EXPECT_EQ(anicodec({"compare", folder / "a.pc2", folder / "a.pc2", "--mesh", folder / "mesh.obj"})
                .status,
            0);
}

TEST(CompareCommand, RefusesClipsOfDifferentLength) {
  TemporaryFolder folder;
  write_sequence(folder / "a.pc2", corpus::make_scaled("cloth", 300, 4));
  write_sequence(folder / "b.pc2", corpus::make_scaled("cloth", 300, 5));
  Outcome outcome = anicodec({"compare", folder / "a.pc2", folder / "b.pc2"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("5 frames"));
}

}  // namespace
}  // namespace anicodec::tools
