// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/stl.h"

#include "tests/tools/io_testing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<float> parse_stl_bytes(std::string_view bytes) {
  std::vector<float> soup;
  LocalOrigin origin;
  LeftKinds left_out;
  parse_stl(bytes, "a.stl", soup, origin, left_out);
  return soup;
}

std::string stl_fault(std::string_view bytes) {
  return fault([&] { parse_stl_bytes(bytes); });
}

// Two triangles that share an edge, and a degenerate one.
MeshSequence fan() {
  MeshSequence s;
  s.vertex_count = 4;
  s.frame_count = 1;
  s.polygons.add(std::vector<uint32_t>{0, 1, 2});
  s.polygons.add(std::vector<uint32_t>{2, 1, 3});
  s.polygons.add(std::vector<uint32_t>{3, 3, 0});
  s.positions = {0, 0, 0, 1, 0, 0, 0, 0.1F, 0, 1.0F / 3, 1, -0.0F};
  return s;
}

TEST(Stl, RoundTripsTrianglesExactly) {
  MeshSequence clip = fan();
  for (bool ascii : {true, false}) {
    std::string bytes;
    append_stl(clip.polygons, clip.positions, ascii, bytes);
    std::vector<float> soup = parse_stl_bytes(bytes);
    StlWeld weld(soup, "a.stl", true);
    FrameArray positions;
    weld.append_vertices(soup, "a.stl", positions);
    EXPECT_EQ(weld.polygons(), clip.polygons);
    EXPECT_EQ(positions, clip.positions);
  }
}

TEST(Stl, WritesPolygonsAsFans) {
  Polygons quad;
  quad.add(std::vector<uint32_t>{0, 1, 3, 2});
  std::string bytes;
  append_stl(quad, fan().positions, false, bytes);
  EXPECT_EQ(bytes.size(), 84U + 2 * 50);
  EXPECT_THAT(StlWeld(parse_stl_bytes(bytes), "", true).polygons().corners,
              ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Stl, KeepsEveryCornerWithoutWelding) {
  MeshSequence clip = fan();
  std::string bytes;
  append_stl(clip.polygons, clip.positions, false, bytes);
  StlWeld weld(parse_stl_bytes(bytes), "a.stl", false);
  EXPECT_EQ(weld.vertex_count(), 9U);
  EXPECT_THAT(weld.polygons().corners, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(Stl, WeldsZeroesOfEitherSign) {
  std::vector<float> soup = {0, 0, 0, -0.0F, 0, 0, 1, 0, 0};
  EXPECT_THAT(StlWeld(soup, "", true).polygons().corners, ElementsAre(0, 0, 1));
}

TEST(Stl, RejectsFramesThatBreakTheWeld) {
  MeshSequence clip = fan();
  std::string bytes;
  append_stl(clip.polygons, clip.positions, false, bytes);
  std::vector<float> soup = parse_stl_bytes(bytes);
  StlWeld weld(soup, "0.stl", true);
  FrameArray positions;
  soup[9] += 1;  // corner 0 of triangle 1
  EXPECT_EQ(
      fault([&] { weld.append_vertices(soup, "1.stl", positions); }),
      "1.stl: corner 0 of triangle 1 and corner 2 of triangle 0 lie apart, but are one vertex "
      "in 0.stl; --no-weld takes every corner as a vertex");
  soup.resize(18);
  EXPECT_EQ(fault([&] { weld.append_vertices(soup, "1.stl", positions); }),
            "1.stl: 2 triangles, but 0.stl has 3");
  EXPECT_TRUE(positions.empty());
}

constexpr const char* kFacet =
    "  FACET normal nan -nan(ind) 0\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n"
    " endloop\n endfacet\n";

TEST(Stl, ReadsAsciiOfSeveralSolids) {
  std::string text = "solid a b\n" + std::string(kFacet) + "endsolid a b\n";
  EXPECT_EQ(parse_stl_bytes(text + "solid\r\n" + kFacet + kFacet + "endsolid\r\n\r\n").size(), 27U);
}

TEST(Stl, ReadsBinaryWhoseHeaderSaysSolid) {
  MeshSequence clip = fan();
  std::string bytes;
  append_stl(clip.polygons, clip.positions, false, bytes);
  bytes.replace(0, 10, "solid name");
  EXPECT_EQ(parse_stl_bytes(bytes).size(), 27U);
}

TEST(Stl, RejectsMalformedAscii) {
  std::string facet(kFacet);
  EXPECT_EQ(stl_fault("solid a\n" + facet),
            "a.stl:9: the file ends where a facet or endsolid is expected");
  EXPECT_THAT(stl_fault("solid a\nendsolid\n"), HasSubstr("no triangle"));
  EXPECT_THAT(stl_fault("solid a\n" + facet + "junk\n"),
              HasSubstr("a.stl:9: 'junk' stands where facet or endsolid"));
  EXPECT_THAT(stl_fault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n"),
              HasSubstr("a.stl:4: coordinate nan of vertex 0"));
  EXPECT_THAT(stl_fault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex"),
              HasSubstr("a.stl:5: 'vertex' is not a coordinate"));
  EXPECT_THAT(stl_fault("solid a\n" + facet + "endsolid\nv 1 2 3\n"),
              HasSubstr("a.stl:10: 'v' stands where 'solid'"));
}

TEST(Stl, RejectsMalformedBinaryNamingBothSizes) {
  MeshSequence clip = fan();
  std::string bytes;
  append_stl(clip.polygons, clip.positions, false, bytes);
  EXPECT_EQ(stl_fault(bytes.substr(0, 200)),
            "a.stl: a binary STL of 3 triangles has 234 bytes, but the file has 200");
  EXPECT_EQ(stl_fault(bytes + "x"),
            "a.stl: a binary STL of 3 triangles has 234 bytes, but the file has 235");
  EXPECT_THAT(stl_fault(bytes.substr(0, 83)), HasSubstr("is not an STL file"));
  EXPECT_EQ(stl_fault(""), "a.stl: the file is empty");
  bytes[84 + 50 + 12 + 15] = '\x7f';  // +inf in corner 1, x of triangle 1
  bytes[84 + 50 + 12 + 14] = '\x80';
  EXPECT_EQ(stl_fault(bytes), "a.stl: corner 1 of triangle 1: the position is not finite");
  EXPECT_THAT(stl_fault(std::string(84, '\0')), HasSubstr("no triangle"));
}

}  // namespace
}  // namespace anicodec::tools
