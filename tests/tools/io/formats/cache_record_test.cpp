// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/cache_record.h"

#include "tests/tools/io_testing.h"
#include "tools/io/load_sequence.h"
#include "tools/io/write_sequence.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

/// Two clips that differ in one coordinate of the last frame, written to a.KIND and b.KIND.
class TwoPairs {
 public:
  explicit TwoPairs(const std::string& kind) {
    MeshSequence clip = awkward_clip(3);
    write_sequence(folder / ("a." + kind), clip);
    clip.positions.back() += 1;
    write_sequence(folder / ("b." + kind), clip);
  }

  TemporaryFolder folder;
};

TEST(CacheRecord, RefusesAMeshAndACacheOfTwoRuns) {
  for (const std::string kind : {"pc2", "mdd"}) {
    TwoPairs pairs(kind);
    const std::string cache = pairs.folder / ("a." + kind);
    EXPECT_EQ(load_sequence(std::vector{cache}).frame_count, 3U);
    fs::rename(pairs.folder / ("b." + kind), cache);
    EXPECT_THAT(
        fault([&] { load_sequence(std::vector{cache}); }),
        HasSubstr("is not the cache that " + (pairs.folder / "a.obj") + " was written with"));
  }
}

TEST(CacheRecord, LetsAMeshMoveByACacheOfAnotherName) {
  TwoPairs pairs("pc2");
  EXPECT_EQ(load_sequence(std::vector{pairs.folder / "a.obj", pairs.folder / "b.pc2"}).frame_count,
            3U);
}

TEST(CacheRecord, AsksNothingOfMeshesWithoutOne) {
  TwoPairs pairs("pc2");
  const std::string text = pairs.folder.read("a.obj");
  pairs.folder.write("a.obj", text.substr(0, text.find('#')));
  fs::rename(pairs.folder / "b.pc2", pairs.folder / "a.pc2");
  EXPECT_EQ(load_sequence(std::vector{pairs.folder / "a.pc2"}).frame_count, 3U);
}

}  // namespace
}  // namespace anicodec::tools
