// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/off.h"

#include "tests/tools/io_testing.h"

#include <bit>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Mesh parse_off_text(std::string_view text) {
  Mesh mesh;
  parse_off(text, "a.off", mesh);
  return mesh;
}

std::string off_fault(std::string_view text) {
  return fault([&] { parse_off_text(text); });
}

TEST(Off, RoundTripsExactly) {
  MeshSequence clip = awkward_clip(1);
  std::string text;
  append_off(clip.polygons, clip.positions, text);
  Mesh mesh = parse_off_text(text);
  EXPECT_EQ(mesh.polygons, clip.polygons);
  ASSERT_EQ(mesh.positions.size(), clip.positions.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_EQ(std::bit_cast<uint32_t>(mesh.positions[i]),
              std::bit_cast<uint32_t>(clip.positions[i]));
}

TEST(Off, ReadsHeaderVariants) {
  std::string face = "3 0 1 2\n";
  EXPECT_EQ(parse_off_text("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + face).polygons.size(), 1U);
  EXPECT_EQ(parse_off_text("OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n" + face).polygons.size(), 1U);
  EXPECT_EQ(parse_off_text("COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 255 0 0 1\n0 1 0 7\n" + face)
                .vertex_count(),
            3U);
  EXPECT_EQ(
      parse_off_text("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n" + face).vertex_count(),
      3U);
  EXPECT_EQ(parse_off_text("STCNOFF\n1 0 0\n0 0 0 0 0 1 1 1 1 1 0 0\n").vertex_count(), 1U);
}

TEST(Off, ReadsCommentsBlankLinesAndFaceColours) {
  Mesh mesh = parse_off_text(
      "# first\r\nOFF # header\r\n\r\n# counts\r\n4 2 5 # counts\r\n0 0 0\r\n\r\n1 0 0 # v\r\n"
      "1 1 0\r\n0 1 0\r\n4 0 1 2 3 0.5 0.5 0.5 1\r\n3 0 0 0 9\r\n# end\r\n");
  ASSERT_EQ(mesh.polygons.size(), 2U);
  EXPECT_THAT(mesh.polygons[0], ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.polygons[1], ElementsAre(0, 0, 0));
}

TEST(Off, RejectsBadHeaders) {
  EXPECT_EQ(off_fault(""), "a.off:1: the file is empty");
  EXPECT_EQ(off_fault("v 0 0 0\n"), "a.off:1: 'v' is not an OFF header");
  EXPECT_THAT(off_fault("4OFF\n"), HasSubstr("other than three coordinates"));
  EXPECT_THAT(off_fault("OFF BINARY\n"), HasSubstr("binary OFF is not read"));
  EXPECT_THAT(off_fault("OFF\n-3 1 0\n"), HasSubstr("-3 is an impossible count of vertices"));
  EXPECT_THAT(off_fault("OFF\n3 1 0 4\n"), HasSubstr("a.off:2: unexpected '4'"));
  EXPECT_THAT(off_fault("OFF\n0 0 0\n"), HasSubstr("has no vertex"));
}

TEST(Off, RejectsBadBodiesNamingTheLine) {
  std::string three = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(off_fault("OFF\n3 1 0\n0 0 0\n"), "a.off:4: the file ends after 1 of 3 vertices");
  EXPECT_EQ(off_fault(three), "a.off:6: the file ends after 0 of 1 faces");
  EXPECT_EQ(off_fault(three + "3 0 1 3\n"),
            "a.off:6: vertex index 3 is out of range; there are 3 vertices");
  EXPECT_THAT(off_fault(three + "3 0 1\n"), HasSubstr("a.off:6: the line ends"));
  EXPECT_THAT(off_fault(three + "2 0 1\n"), HasSubstr("a.off:6: a face of 2 corners"));
  EXPECT_THAT(off_fault(three + "3 0 1 2\n3 0 1 2\n"), HasSubstr("a.off:7: unexpected '3'"));
  EXPECT_THAT(off_fault("OFF\n1 0 0\n0 nan 0\n"), HasSubstr("a.off:3: coordinate nan of vertex 0"));
  EXPECT_THAT(off_fault("OFF\n1 0 0\n0 0 0 1 1 1\n"), HasSubstr("does not fit the header"));
  EXPECT_THAT(off_fault("OFF\n1 0 0\n0 x 0\n"), HasSubstr("a.off:3: 'x' is not a coordinate"));
  EXPECT_THAT(off_fault("OFF\n2000000000 1 0\n0 0 0\n"), HasSubstr("1 of 2000000000 vertices"));
}

}  // namespace
}  // namespace anicodec::tools
