// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "build_paths.h"
#include "corpus/clips.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace anicodec::corpus {
namespace {

const char kPath[] = ANICODEC_SOURCE_DIR "/corpus/manifest.json";

// ANICODEC_UPDATE=1 writes the file instead: to be used when a clip is added or changed on purpose.
TEST(Manifest, AgreesWithTheClips) {
  const char* update = std::getenv("ANICODEC_UPDATE");
  if (update != nullptr && std::string(update) == "1")
    std::ofstream(kPath) << manifest();
  std::ostringstream committed;
  committed << std::ifstream(kPath).rdbuf();
  EXPECT_EQ(committed.str(), manifest());
}

}  // namespace
}  // namespace anicodec::corpus
