// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/tools/command_testing.h"
#include "tools/io/load_sequence.h"

#include <string>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(CorpusCommand, SubdividesAClip) {
  TemporaryFolder folder;
  for (const char* levels : {"1", "2"}) {
    const Outcome outcome =
        anicodec({"corpus", "limb", "--vertices", "100", "--frame-count", "3", "--subdivide",
                  levels, "-o", folder / (std::string("fine") + levels + ".pc2")});
    ASSERT_EQ(outcome.status, 0) << outcome;
  }
  const std::string once = folder / "fine1.pc2", twice = folder / "fine2.pc2";
  const MeshSequence a = load_sequence({&once, 1}), b = load_sequence({&twice, 1});
  EXPECT_EQ(a.frame_count, 3U);
  EXPECT_EQ(b.polygons.size(), 4 * a.polygons.size());
}

}  // namespace
}  // namespace anicodec::tools
