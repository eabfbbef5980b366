// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/private_folder.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace anicodec::peers {
namespace {

TEST(PrivateFolder, GoesWithAllThatIsInIt) {
  std::string file;
  {
    const tools::PrivateFolder folder;
    file = folder / "a";
    std::ofstream(file) << "x";
    EXPECT_TRUE(std::filesystem::exists(file));
  }
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(file).parent_path()));
}

}  // namespace
}  // namespace anicodec::peers
