// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/own_file.h"

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(OwnFile, IsTheProgram) {
  EXPECT_TRUE(own_file().is_absolute());
  EXPECT_TRUE(std::filesystem::equivalent(own_file(), "/proc/self/exe"));
}

}  // namespace
}  // namespace anicodec::tools
