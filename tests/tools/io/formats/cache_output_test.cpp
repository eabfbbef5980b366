// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/cache_output.h"

#include "tests/tools/io_testing.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/formats/vertex_cache.h"
#include "tools/io/write_sequence.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(CacheOutput, WritesPositionsInTheOrderOfTheFormat) {
  EXPECT_EQ(mesh_of_cache("a.b/clip.pc2"), "a.b/clip.obj");
  const TemporaryFolder folder;
  const MeshSequence clip = awkward_clip(3);
  for (const char* name : {"c.pc2", "d.mdd"}) {
    write_sequence(folder / name, clip);
    const ByteSource source = file_source(folder / name);
    const VertexCache cache = std::string(name) == "c.pc2" ? open_pc2(source) : open_mdd(source);
    EXPECT_EQ(cache.frame_count, 3);
    std::vector<float> positions(clip.positions.size());
    read_positions(cache, source, positions);
    EXPECT_TRUE(std::equal(positions.begin(), positions.end(), clip.positions.begin())) << name;
  }
  EXPECT_EQ(open_mdd(file_source(folder / "d.mdd")).times, times_of(clip));
  EXPECT_THAT(folder.files(), testing::ElementsAre("c.obj", "c.pc2", "d.mdd", "d.obj"));
}

}  // namespace
}  // namespace anicodec::tools
