// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/batch_clips.h"

#include "corpus/clips.h"
#include "tests/tools/command_testing.h"
#include "tools/io/write_sequence.h"

#include <filesystem>
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

std::vector<std::string> names_of(const std::vector<BatchClip>& clips) {
  std::vector<std::string> names;
  for (const BatchClip& clip : clips)
    names.push_back(clip.name);
  return names;
}

TEST(BatchClips, AreScenesCachesAndNumberedFramesOfAllFolders) {
  TemporaryFolder folder;
  for (const char* file : {"walk.pc2", "walk.obj", "fox.glb", "readme.txt", "scan/frame_2.ply",
                           "scan/frame_10.ply", "scan/frame_1.ply", "scan/1.off", "scan/2.off",
                           "lone_1.obj", "deep/run.mdd", "deep/run.obj"})
    folder.write(file, "x");
  std::vector<BatchClip> clips = find_clips(folder / ".");
  EXPECT_THAT(names_of(clips), ElementsAre("fox", "walk", "deep/run", "scan/scan", "scan/frame"));
  ASSERT_THAT(clips, SizeIs(5));
  ASSERT_THAT(clips[4].inputs, SizeIs(3));
  EXPECT_THAT(clips[4].inputs[2], HasSubstr("frame_10.ply"));
  EXPECT_THAT(clips[1].inputs, SizeIs(1));
}

TEST(BatchClips, AreStagesUntilOthersTakeThem) {
  TemporaryFolder folder;
  folder.write("shot.usdc", "x");
  EXPECT_THAT(names_of(find_clips(folder / ".")), ElementsAre("shot"));
  const Outcome outcome = anicodec({"encode", "--batch", folder / ".", "-o", folder / "out"});
  EXPECT_EQ(outcome.status, 2) << outcome;
  EXPECT_THAT(outcome.out, HasSubstr("pip install 'anicodec[usd]'"));
}

TEST(BatchClips, HaveFramesBelowZeroAndBetweenFrames) {
  TemporaryFolder folder;
  for (const char* file :
       {"sim.-0010.obj", "sim.-0009.obj", "sim.0000.obj", "sub.1.obj", "sub.1.25.obj",
        "sub.1.5.obj", "take.1.0001.obj", "take.1.0002.obj", "take.2.0001.obj", "take.2.0002.obj"})
    folder.write(file, "x");
  const std::vector<BatchClip> clips = find_clips(folder / ".");
  EXPECT_THAT(names_of(clips), ElementsAre("sim", "sub", "take.1", "take.2"));
  EXPECT_THAT(clips[0].inputs, ElementsAre(HasSubstr("-0010.obj"), HasSubstr("-0009.obj"),
                                           HasSubstr("sim.0000.obj")));
  EXPECT_THAT(clips[1].inputs,
              ElementsAre(HasSubstr("sub.1.obj"), HasSubstr("1.25.obj"), HasSubstr("1.5.obj")));
}

TEST(BatchClips, ComeFromAListWithInputsBetweenTabs) {
  TemporaryFolder folder;
  const std::string list =
      folder.write("list.txt", "# clips\n\na/walk.obj\ta/walk.pc2\r\nruns/*.obj\n");
  std::vector<BatchClip> clips = find_clips(list);
  EXPECT_THAT(names_of(clips), ElementsAre("walk", "runs"));
  EXPECT_THAT(clips[0].inputs, ElementsAre("a/walk.obj", "a/walk.pc2"));
}

TEST(BatchClips, MustBeFoundAndHaveDifferentNames) {
  TemporaryFolder folder;
  EXPECT_THAT(fault([&] { find_clips(folder / "."); }), HasSubstr("no clip is found"));
  folder.write("a.glb", "x");
  folder.write("a.mdd", "x");
  EXPECT_THAT(fault([&] { find_clips(folder / "."); }, ErrorKind::kUsage),
              HasSubstr("a.mdd: would be written to a.anic, and so would "));
}

}  // namespace
}  // namespace anicodec::tools
