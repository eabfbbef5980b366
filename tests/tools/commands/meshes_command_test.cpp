// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips of several meshes, by the command.
#include "tests/codec/edited_file.h"
#include "tests/tools/command_testing.h"
#include "tests/two_boxes.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <chrono>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Meshes : public testing::Test {
 protected:
  void SetUp() override {
    write_sequence(folder_ / "in/f_%02d.obj", two_boxes(), {});
    const Outcome outcome = anicodec({"encode", folder_ / "in/*.obj", "-o", folder_ / "a.anic",
                                      "--split-objects", "--kg", "0.1", "--fps", "25"});
    ASSERT_EQ(outcome.status, 0) << outcome;
    EXPECT_THAT(outcome.out, HasSubstr("; 12 frames at 25 fps (asked); 2 meshes; max error "));
  }

  MeshSequence frame(const std::string& path) {
    return load_sequence(std::vector<std::string>{folder_ / path});
  }

  TemporaryFolder folder_;
};

TEST_F(Meshes, HaveNamesAndFrames) {
  const nlohmann::json info = anicodec({"info", folder_ / "a.anic", "--json"}).json();
  ASSERT_EQ(info["meshes"].size(), 2U);
  EXPECT_EQ(info["meshes"][0]["name"], "turning");
  EXPECT_EQ(info["meshes"][1]["name"], "still");
  EXPECT_EQ(info["meshes"][1]["frames"], (nlohmann::json{{0, 4}, {8, 12}}));
  EXPECT_LE(info["kg"], 0.1);
  EXPECT_THAT(anicodec({"info", folder_ / "a.anic"}).out, HasSubstr("2 meshes, 12 frames"));
  EXPECT_EQ(anicodec({"verify", folder_ / "a.anic"}).status, 0);
}

TEST_F(Meshes, AreWrittenWhereTheyAre) {
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "out/f_%02d.obj"}).status, 0);
  const MeshSequence both = frame("out/f_00.obj"), one = frame("out/f_05.obj");
  EXPECT_EQ(both.vertex_count, frame("in/f_00.obj").vertex_count);
  EXPECT_THAT(both.parts.names, ElementsAre("turning", "still"));
  EXPECT_EQ(2 * one.vertex_count, both.vertex_count);
  ASSERT_EQ(anicodec({"decode", folder_ / "a.anic", "-o", folder_ / "b.glb"}).status, 0);
}

TEST_F(Meshes, CompareAsOne) {
  const Outcome outcome =
      anicodec({"compare", folder_ / "in/*.obj", folder_ / "a.anic", "--json", "--no-sted"});
  ASSERT_EQ(outcome.status, 0) << outcome;
  EXPECT_LE(outcome.json()["kg"], 0.1001);
}

/// The same file, which announces as many frames as the format has numbers for.
TEST_F(Meshes, OfFramesThatShowNothingCostNothing) {
  constexpr uint32_t kFrames = (1 << 24) - 1;
  const std::string bytes = folder_.read("a.anic");
  EditedFile edited(Bytes(bytes.begin(), bytes.end()));
  edited.change_limits([](Limits& limits) {
    limits.frames = kFrames;
    limits.clip_frames.assign(1, limits.frames);
  });
  const Bytes long_one = edited.bytes();
  folder_.write("long.anic", std::string(long_one.begin(), long_one.end()));

  const auto start = std::chrono::steady_clock::now();
  const Outcome info = anicodec({"info", folder_ / "long.anic", "--json"});
  EXPECT_EQ(info.json()["frames"], kFrames);
  EXPECT_EQ(info.json()["meshes"][1]["frames"], (nlohmann::json{{0, 4}, {8, 12}}));
  EXPECT_EQ(anicodec({"verify", folder_ / "long.anic"}).status, 0);
  for (const char* output : {"long.pc2", "long.glb", "long.abc"}) {
    const Outcome decoded = anicodec({"decode", folder_ / "long.anic", "-o", folder_ / output});
    EXPECT_EQ(decoded.status, 2) << decoded;
    EXPECT_THAT(decoded.err, HasSubstr("16777203 of 16777215 frames show nothing"));
  }
  const Outcome compared = anicodec({"compare", folder_ / "long.anic", folder_ / "long.anic"});
  EXPECT_EQ(compared.status, 2) << compared;
  EXPECT_EQ(anicodec({"export-vat", folder_ / "long.anic", "-o", folder_ / "textures"}).status, 2);
  ASSERT_EQ(
      anicodec({"decode", folder_ / "long.anic", "--frames", "0:20", "-o", folder_ / "some.pc2"})
          .status,
      0);
  ASSERT_EQ(anicodec({"decode", folder_ / "long.anic", "-o", folder_ / "all/f_%02d.obj"}).status,
            0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
  EXPECT_EQ(frame("all/f_05.obj").vertex_count, frame("all/f_11.obj").vertex_count / 2);
}

TEST_F(Meshes, GoWithoutMassageAndParts) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--massage", "on"}, {"--part", "0:3"}, {"--size", "10k"}}) {
    std::vector<std::string> arguments{"encode", folder_ / "in/*.obj", "-o", folder_ / "b.anic",
                                       "--split-objects"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(anicodec(arguments).status, 1);
  }
}

}  // namespace
}  // namespace anicodec::tools
