// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/atomic_file.h"

#include "tests/tools/io_testing.h"

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(AtomicFile, AppearsOnCommitOnly) {
  TemporaryFolder folder;
  {
    AtomicFile file(folder / "a", false);
    file.write("hello ");
    file.write("world");
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    file.commit();
  }
  EXPECT_EQ(folder.read("a"), "hello world");
  EXPECT_THAT(folder.files(), ElementsAre("a"));
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  TemporaryFolder folder;
  folder.write("a", "before");
  {
    AtomicFile file(folder / "a", true);
    file.write("after");
    EXPECT_EQ(folder.files().size(), 2U);
  }
  EXPECT_THAT(folder.files(), ElementsAre("a"));
  EXPECT_EQ(folder.read("a"), "before");
}

TEST(AtomicFile, RefusesExistingOutputsUnlessOverwriting) {
  TemporaryFolder folder;
  std::string path = folder.write("a", "before");
  EXPECT_EQ(fault([&] { AtomicFile(path, false); }, ErrorKind::kUsage),
            path + ": the file exists already");
  AtomicFile file(path, true);
  file.write("after");
  file.commit();
  EXPECT_EQ(folder.read("a"), "after");
}

TEST(AtomicFile, RefusesAnOutputThatCameToExist) {
  TemporaryFolder folder;
  {
    AtomicFile file(folder / "a", false);
    folder.write("a", "other");
    EXPECT_THAT(fault([&] { file.commit(); }, ErrorKind::kUsage), HasSubstr("exists already"));
  }
  EXPECT_THAT(folder.files(), ElementsAre("a"));
  EXPECT_EQ(folder.read("a"), "other");
}

TEST(AtomicFile, RefusesWhatIsNoRegularFile) {
  TemporaryFolder folder;
  EXPECT_THAT(fault([&] { AtomicFile(folder / ".", true); }, ErrorKind::kUsage),
              HasSubstr("is a directory"));
  EXPECT_THAT(fault([] { AtomicFile("/dev/null", true); }, ErrorKind::kUsage),
              HasSubstr("is not a regular file"));
  folder.write("file", "");
  EXPECT_THAT(fault([&] { AtomicFile(folder / "file/a", false); }, ErrorKind::kUsage),
              HasSubstr("file cannot be made"));
}

TEST(AtomicFile, MakesItsFoldersWhichGoWithoutCommit) {
  TemporaryFolder folder;
  { AtomicFile file(folder / "new/inner/a", false); }
  EXPECT_THAT(folder.files(), IsEmpty());
  AtomicFile file(folder / "new/inner/a", false);
  file.write("b");
  file.commit();
  EXPECT_EQ(folder.read("new/inner/a"), "b");
}

TEST(AtomicFile, WritesThroughSymbolicLinks) {
  TemporaryFolder folder;
  folder.write("target", "before");
  std::filesystem::create_symlink("target", folder / "link");
  AtomicFile file(folder / "link", true);
  file.write("after");
  file.commit();
  EXPECT_EQ(folder.read("target"), "after");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
}

TEST(AtomicFile, FailsOnAFullDiskNamingTheFile) {
  TemporaryFolder folder;
  rlimit before;
  ::getrlimit(RLIMIT_FSIZE, &before);
  auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string at_write = fault(
      [&] {
        AtomicFile file(folder / "a", false);
        for (int i = 0; i < 1000; ++i)
          file.write(std::string(1000, 'x'));
      },
      ErrorKind::kInternal);
  std::string at_commit = fault(
      [&] {
        AtomicFile file(folder / "b", false);
        file.write(std::string(1001, 'x'));
        file.commit();
      },
      ErrorKind::kInternal);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(at_write, HasSubstr(folder / "a: cannot be written"));
  EXPECT_THAT(at_commit, HasSubstr(folder / "b: cannot be written"));
  EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(AtomicFile, CommitsAllOrNone) {
  TemporaryFolder folder;
  {
    std::vector<AtomicFile> files;
    for (const char* name : {"a", "b", "c"}) {
      files.emplace_back(folder / name, false);
      files.back().write(name);
    }
    folder.write("b", "other");
    EXPECT_THAT(fault([&] { commit_all(files); }, ErrorKind::kUsage), HasSubstr("b: the file"));
  }
  EXPECT_THAT(folder.files(), ElementsAre("b"));
}

TEST(AtomicFile, IsRemovedBySignals) {
  for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGABRT}) {
    TemporaryFolder folder;
    pid_t child = ::fork();
    if (child == 0) {
      std::signal(signal, SIG_DFL);
      install_cleanup_on_signal();
      std::vector<AtomicFile> files;
      for (const char* name : {"a", "b", "c"})
        files.emplace_back(folder / name, false);
      files[1].commit();
      ::raise(signal);
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_THAT(folder.files(), ElementsAre("b"));
  }
}

TEST(AtomicFile, IgnoresTheSignalOfAFileThatIsTooLarge) {
  TemporaryFolder folder;
  pid_t child = ::fork();
  if (child == 0) {
    install_cleanup_on_signal();
    const rlimit small = {1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &small);
    try {
      AtomicFile file(folder / "a", false);
      file.write(std::string(2000, 'x'));
      file.commit();
    } catch (const Error&) {
      ::_exit(7);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(AtomicFile, KeepsTheModeOfWhatItReplaces) {
  TemporaryFolder folder;
  const std::string path = folder.write("a", "before");
  ::chmod(path.c_str(), 0640);
  AtomicFile file(path, true);
  file.write("after");
  file.commit();
  EXPECT_EQ(folder.read("a"), "after");
  struct stat status;
  ::stat(path.c_str(), &status);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
}

/// A folder under the name of an output cannot be replaced by a file.
void put_folder_in_the_way(const TemporaryFolder& folder, const std::string& name) {
  std::filesystem::remove(folder / name);
  std::filesystem::create_directory(folder / name);
  folder.write(name + "/in it", "");
}

TEST(AtomicFile, PutsBackWhatItReplacedWhenOneOfASetFails) {
  TemporaryFolder folder;
  folder.write("a", "old a");
  folder.write("c", "old c");
  {
    std::vector<AtomicFile> files;
    for (const char* name : {"a", "b", "c", "d"}) {
      files.emplace_back(folder / name, true);
      files.back().write("new");
    }
    put_folder_in_the_way(folder, "d");
    EXPECT_THAT(fault([&] { commit_all(files); }, ErrorKind::kInternal),
                HasSubstr("/d: cannot be "));
  }
  EXPECT_THAT(folder.files(), ElementsAre("a", "c", "d"));
  EXPECT_EQ(folder.read("a"), "old a");
  EXPECT_EQ(folder.read("c"), "old c");
}

TEST(AtomicFile, KeepsWhatASingleFailedCommitWouldReplace) {
  TemporaryFolder folder;
  folder.write("a", "old");
  AtomicFile file(folder / "a", true);
  put_folder_in_the_way(folder, "a");
  EXPECT_THAT(fault([&] { file.commit(); }, ErrorKind::kInternal), HasSubstr("cannot be replaced"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a/in it"));
}

}  // namespace
}  // namespace anicodec::tools
