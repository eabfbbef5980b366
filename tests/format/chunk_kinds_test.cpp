// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/chunk_kinds.h"

#include "build_paths.h"

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(ChunkKinds, AreThoseOfTheSpecification) {
  std::ifstream in(ANICODEC_SOURCE_DIR "/spec/06-chunks.md");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  // | `TYPE` | holds | mesh | segment | how many | flag | section |
  const std::regex row(
      R"(\n\| `(\w{4})` \|[^|\n]*\| (\w+) \| ([\w ]+) \|[^|\n]*\| (\w+) \| \d+ \|)");
  std::set<const ChunkKind*> specified;
  for (std::sregex_iterator it(page.begin(), page.end(), row), end; it != end; ++it) {
    const std::string type = (*it)[1], mesh = (*it)[2], segment = (*it)[3], flag = (*it)[4];
    SCOPED_TRACE(type);
    char name[5] = {type[0], type[1], type[2], type[3]};
    const ChunkKind* kind = find_chunk_kind(chunk_type(name));
    ASSERT_TRUE(kind);
    EXPECT_TRUE(specified.insert(kind).second);
    EXPECT_EQ(mesh == "none", kind->owner == ChunkOwner::kClip);
    EXPECT_EQ(segment.starts_with("none"), kind->owner != ChunkOwner::kSegment);
    EXPECT_EQ(segment.ends_with("s"), is_of_segments(*kind));
    EXPECT_EQ(flag == "required", kind->required);
    EXPECT_EQ(flag == "copied", kind->copied);
  }
  EXPECT_EQ(specified.size(), std::size(kChunkKinds));
}

TEST(ChunkKinds, KnowsNoOthers) {
  for (const char(*name)[5] : {&"LIMJ", &"limi", &"\0\0\0\0", &"IMIL"})
    EXPECT_FALSE(find_chunk_kind(chunk_type(*name)));
}

}  // namespace
}  // namespace anicodec
