// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/staging.h"

#include "tests/tools/io_testing.h"
#include "tools/io/files/commit_record.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

namespace fs = std::filesystem;

/// A set of "a" and "b" as a run leaves it that is killed with the record written and "a" renamed.
class KilledRun {
 public:
  KilledRun() {
    folder.write("a", "old a");
    folder.write("b", "old b");
    fs::create_directory(staging);
    folder.write(".anicodec-stage-killed/0", "new a");
    folder.write(".anicodec-stage-killed/1", "new b");
    for (uint32_t i = 0; i < 2; ++i) {
      const std::string name(1, static_cast<char>('a' + i));
      files.push_back(
          {i, name, identity_of(folder / name), identity_of(staging + "/" + std::to_string(i))});
      fs::create_hard_link(folder / name, staging + "/" + std::to_string(i) + ".old");
    }
    write_commit_record(staging, files);
    fs::rename(staging + "/0", folder / "a");
  }

  TemporaryFolder folder;
  std::string staging = folder / ".anicodec-stage-killed";
  std::vector<Replacement> files;
};

TEST(Staging, FinishesWhatAKilledRunHasBegun) {
  KilledRun run;
  EXPECT_THAT(recover_folder(run.folder / ""), IsEmpty());
  EXPECT_EQ(run.folder.read("a"), "new a");
  EXPECT_EQ(run.folder.read("b"), "new b");
  EXPECT_THAT(run.folder.files(), ElementsAre("a", "b"));
}

TEST(Staging, PutsBackWhatAKilledRunWasPuttingBack) {
  KilledRun run;
  turn_commit_record(run.staging);
  EXPECT_THAT(recover_folder(run.folder / ""), IsEmpty());
  EXPECT_EQ(run.folder.read("a"), "old a");
  EXPECT_EQ(run.folder.read("b"), "old b");
  EXPECT_THAT(run.folder.files(), ElementsAre("a", "b"));
}

TEST(Staging, LeavesWhatSomebodyHasWrittenSince) {
  KilledRun run;
  run.folder.write("b", "another b");
  recover_folder(run.folder / "");
  EXPECT_EQ(run.folder.read("b"), "another b");
  EXPECT_THAT(run.folder.files(), ElementsAre("a", "b"));
}

TEST(Staging, DropsARecordThatIsDamaged) {
  KilledRun run;
  fs::resize_file(run.staging + "/commit", fs::file_size(run.staging + "/commit") - 3);
  recover_folder(run.folder / "");
  EXPECT_EQ(run.folder.read("b"), "old b");
  EXPECT_THAT(run.folder.files(), ElementsAre("a", "b"));
}

TEST(Staging, NeverRenamesOutOfItsFolder) {
  KilledRun run;
  run.folder.write("sub/x", "");
  run.files[1].name = "sub/x";
  run.files[1].before = identity_of(run.folder / "sub/x");
  write_commit_record(run.staging, run.files);
  recover_folder(run.folder / "");
  EXPECT_EQ(run.folder.read("sub/x"), "");
}

TEST(Staging, LeavesTheFolderOfARunThatLives) {
  TemporaryFolder folder;
  const LockedFolder other(folder / "", ".anicodec-stage-");
  recover_folder(folder / "");
  EXPECT_TRUE(fs::exists(other.path()));
}

TEST(Staging, KnowsWhichFilesWait) {
  KilledRun run;
  EXPECT_THAT(unfinished_names(run.staging), ElementsAre("b"));
}

TEST(Staging, IsSharedByTheOutputsOfAFolder) {
  TemporaryFolder folder;
  const auto first = Staging::in(folder / ""), second = Staging::in(folder / "");
  EXPECT_EQ(first, second);
  EXPECT_NE(first->take_number(), second->take_number());
}

}  // namespace
}  // namespace anicodec::tools
