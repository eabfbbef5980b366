// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Clips of several meshes, by the command.
#include "tests/tools/command_testing.h"
#include "tests/two_boxes.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

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
