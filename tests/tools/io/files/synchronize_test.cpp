// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The disk that is left when the power goes is for tests/tools/power_loss.
#include "tools/io/files/synchronize.h"

#include "tests/tools/io_testing.h"

#include <cerrno>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace anicodec::tools {
namespace {

TEST(Synchronize, TellsAFaultFromAFileThatHasNoDisk) {
  TemporaryFolder folder;
  folder.write("a", "x");
  const int file = ::open((folder / "a").c_str(), O_WRONLY);
  EXPECT_TRUE(synchronize(file));
  ::close(file);
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  EXPECT_TRUE(synchronize(pipe[1]));
  ::close(pipe[0]);
  ::close(pipe[1]);
  EXPECT_FALSE(synchronize(file));
  EXPECT_EQ(errno, EBADF);
}

TEST(Synchronize, TakesFoldersThatAreGone) {
  TemporaryFolder folder;
  synchronize_folder("");
  synchronize_folder(folder / "none");
}

}  // namespace
}  // namespace anicodec::tools
