// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/encoding/batch.h"

#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class BatchCommand : public testing::Test {
 protected:
  BatchCommand() {
    for (const char* name : {"limb", "one_triangle", "quad_box"}) {
      fs::create_directories(folder_ / "in");
      write_sequence(folder_ / ("in/" + std::string(name) + ".pc2"), corpus::make_clip(name));
    }
  }

  Outcome batch(std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"encode", "--batch", folder_ / "in", "-o", folder_ / "out",
                                     "--effort", "fast"});
    return anicodec(options);
  }

  TemporaryFolder folder_;
};

TEST_F(BatchCommand, EncodesEveryClipOnceWithALineForEach) {
  Outcome first = batch({"-j", "2"});
  ASSERT_EQ(first.status, 0) << first;
  EXPECT_THAT(first.out, HasSubstr("[3/3] "));
  EXPECT_THAT(first.out, HasSubstr("3 encoded, 0 done before, 0 failed; "));
  for (const char* name : {"limb", "one_triangle", "quad_box"})
    EXPECT_EQ(anicodec({"verify", folder_ / ("out/" + std::string(name) + ".anic")}).status, 0);

  Outcome again = batch();
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.out, HasSubstr("0 encoded, 3 done before, 0 failed"));
}

TEST_F(BatchCommand, RemovesWhatAKilledRunLeftEvenWithNothingToDo) {
  ASSERT_EQ(batch().status, 0);
  const std::string left = folder_ / "out/.anicodec-stage-AbCdEf";
  fs::create_directory(left);
  folder_.write("out/.anicodec-stage-AbCdEf/0", "half a file");
  EXPECT_THAT(batch().out, HasSubstr("0 encoded, 3 done before, 0 failed"));
  EXPECT_FALSE(fs::exists(left));
}

TEST_F(BatchCommand, PrintsAnObjectForEachClip) {
  folder_.write("in/broken.glb", "no glTF");
  const Outcome outcome = batch({"--json"});
  EXPECT_EQ(outcome.status, 2) << outcome;
  std::istringstream text(outcome.out);
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(text, line);)
    lines.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(lines.size(), 6U) << outcome.out;  // four clips, the summary and the error
  EXPECT_EQ(lines[4]["encoded"], 3);
  EXPECT_EQ(lines[4]["failed"], 1);
  EXPECT_EQ(lines[5]["status"], 2);
}

TEST_F(BatchCommand, RefusesAListThatIsBinary) {
  const std::string list = folder_.write("list.txt", std::string("a\0b.pc2\n", 8));
  EXPECT_THAT(anicodec({"encode", "--batch", list, "-o", folder_ / "out"}).err,
              HasSubstr("is no list of clips but a binary file"));
}

TEST_F(BatchCommand, EncodesAgainWhatHasChanged) {
  ASSERT_EQ(batch().status, 0);
  EXPECT_THAT(batch({"--kg", "1"}).out, HasSubstr("3 encoded, 0 done before"));
  MeshSequence clip = corpus::make_clip("limb");
  clip.positions[0] += 1;
  write_sequence(folder_ / "in/limb.pc2", clip, {.overwrite = true});
  EXPECT_THAT(batch({"--kg", "1"}).out, HasSubstr("1 encoded, 2 done before"));
  fs::remove(folder_ / "out/quad_box.anic");
  EXPECT_THAT(batch({"--kg", "1"}).out, HasSubstr("1 encoded, 2 done before"));
}

TEST_F(BatchCommand, GoesOnAfterAFailureAndTellsIt) {
  folder_.write("in/broken.glb", "glTF");
  Outcome outcome = batch();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.out, HasSubstr("broken: FAILED: "));
  EXPECT_THAT(outcome.out, HasSubstr("3 encoded, 0 done before, 1 failed"));
  EXPECT_THAT(outcome.err, HasSubstr("1 of 4 clips failed, the first is broken"));
  EXPECT_FALSE(fs::exists(folder_ / "out/broken.anic"));
}

// A document that is its own part, which the library that reads it follows until its stack ends.
TEST_F(BatchCommand, GoesOnAfterALibraryCrashes) {
  folder_.write("in/endless.dae",
                R"(<?xml version="1.0"?><COLLADA version="1.4.1"><library_nodes><node id="n">)"
                R"(<instance_node url="#n"/></node></library_nodes><library_visual_scenes>)"
                R"(<visual_scene id="v"><node><instance_node url="#n"/></node></visual_scene>)"
                R"(</library_visual_scenes><scene><instance_visual_scene url="#v"/></scene>)"
                R"(</COLLADA>)");
  const Outcome outcome = batch();
  EXPECT_THAT(outcome.out, HasSubstr("endless: FAILED: "));
  EXPECT_THAT(outcome.out, HasSubstr("3 encoded, 0 done before, 1 failed"));
  EXPECT_THAT(outcome.err, HasSubstr("1 of 4 clips failed, the first is endless"));
}

TEST_F(BatchCommand, LeavesFilesThatItDidNotWrite) {
  folder_.write("out/limb.anic", "mine");
  Outcome outcome = batch();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("limb: FAILED: "));
  EXPECT_EQ(folder_.read("out/limb.anic"), "mine");
  EXPECT_EQ(batch({"-f"}).status, 0);
}

TEST_F(BatchCommand, KeepsWithinAMemoryCap) {
  EXPECT_EQ(batch({"-j", "3", "--memory", "1"}).status, 0) << "one after the other";
  EXPECT_EQ(batch({"--memory", "lots"}).status, 1);
}

}  // namespace
}  // namespace anicodec::tools
