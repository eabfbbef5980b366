// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/vertex_cache.h"

#include "tests/tools/io_testing.h"
#include "tools/io/base/byte_order.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Two vertices, three frames, positions 0 .. 17.
std::string pc2() {
  std::string bytes;
  append_pc2_header(2, 3, bytes);
  for (int i = 0; i < 18; ++i)
    append(static_cast<float>(i), std::endian::little, bytes);
  return bytes;
}

std::string mdd() {
  std::string bytes;
  append_mdd_header(2, std::vector<float>{0, 0.5F, 1}, bytes);
  for (int i = 0; i < 18; ++i)
    append(static_cast<float>(i), std::endian::big, bytes);
  return bytes;
}

std::string pc2_fault(const std::string& bytes) {
  return fault([&] { open_pc2(memory_source(bytes, "a.pc2")); });
}

std::string mdd_fault(const std::string& bytes) {
  return fault([&] { open_mdd(memory_source(bytes, "a.mdd")); });
}

TEST(VertexCache, ReadsWhatItWrites) {
  for (bool is_pc2 : {true, false}) {
    std::string bytes = is_pc2 ? pc2() : mdd();
    ByteSource source = memory_source(bytes, "a");
    VertexCache cache = is_pc2 ? open_pc2(source) : open_mdd(source);
    EXPECT_EQ(cache.vertex_count, 2U);
    EXPECT_EQ(cache.frame_count, 3U);
    std::vector<float> positions(18);
    read_positions(cache, source, positions);
    for (size_t i = 0; i < 18; ++i)
      EXPECT_EQ(positions[i], static_cast<float>(i));
  }
}

TEST(VertexCache, HasTheBytesOfTheFormats) {
  EXPECT_EQ(pc2().substr(0, 32),
            std::string("POINTCACHE2\0\1\0\0\0\2\0\0\0\0\0\0\0\0\0\x80\x3f\3\0\0\0", 32));
  EXPECT_EQ(mdd().substr(0, 20), std::string("\0\0\0\3\0\0\0\2\0\0\0\0\x3f\0\0\0\x3f\x80\0\0", 20));
}

TEST(VertexCache, RejectsFalseSizesNamingExpectedAndActual) {
  EXPECT_EQ(pc2_fault(pc2().substr(0, 50)),
            "a.pc2: truncated: 2 vertices x 3 frames take 104 bytes, but the file has 50");
  EXPECT_EQ(pc2_fault(pc2() + "x"),
            "a.pc2: trailing bytes: 2 vertices x 3 frames take 104 bytes, but the file has 105");
  EXPECT_EQ(mdd_fault(mdd().substr(0, 91)),
            "a.mdd: truncated: 2 vertices x 3 frames take 92 bytes, but the file has 91");
  EXPECT_THAT(mdd_fault(mdd() + "x"), HasSubstr("a.mdd: trailing bytes"));
  EXPECT_EQ(pc2_fault(pc2().substr(0, 31)),
            "a.pc2: truncated: the header of a PC2 has 32 bytes, the file has 31");
  EXPECT_EQ(mdd_fault(""), "a.mdd: truncated: the header of an MDD has 8 bytes, the file has 0");
}

TEST(VertexCache, RejectsForeignHeaders) {
  std::string bytes = pc2();
  bytes[0] = 'Q';
  EXPECT_THAT(pc2_fault(bytes), HasSubstr("is not a PC2"));
  bytes = pc2();
  bytes[12] = 2;
  EXPECT_THAT(pc2_fault(bytes), HasSubstr("version 2"));
  bytes = pc2();
  bytes[16] = 0;
  EXPECT_THAT(pc2_fault(bytes), HasSubstr("the cache is empty: 0 vertices, 3 frames"));
  bytes[16] = 2;
  bytes[19] = '\x80';
  EXPECT_THAT(pc2_fault(bytes), HasSubstr("impossible counts"));
  EXPECT_THAT(mdd_fault(std::string(8, '\xff')), HasSubstr("impossible counts"));
  EXPECT_THAT(mdd_fault(std::string("\0\xff\xff\xff\x7f\xff\xff\xff", 8)), HasSubstr("truncated"));
}

TEST(VertexCache, RejectsNonFinitePositionsNamingFrameAndVertex) {
  std::string bytes;
  append(static_cast<float>(NAN), std::endian::little, bytes);
  std::string file = pc2().replace(32 + 4 * 10, 4, bytes);
  ByteSource source = memory_source(file, "a.pc2");
  std::vector<float> positions(18);
  EXPECT_EQ(fault([&] { read_positions(open_pc2(source), source, positions); }),
            "a.pc2: frame 1, vertex 1: the position is not finite");
}

}  // namespace
}  // namespace anicodec::tools
