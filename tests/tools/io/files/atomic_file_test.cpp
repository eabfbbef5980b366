// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/atomic_file.h"

#include "tests/tools/io_testing.h"

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
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
  EXPECT_THAT(fault([&] { AtomicFile(folder / "none/a", false); }, ErrorKind::kUsage),
              HasSubstr("none/a: cannot be created: No such file"));
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
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
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

}  // namespace
}  // namespace anicodec::tools
