// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/obj.h"

#include "tests/tools/io_testing.h"

#include <bit>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Mesh parse_obj_text(std::string_view text) {
  Mesh mesh;
  parse_obj(text, "a.obj", mesh);
  return mesh;
}

std::string obj_fault(std::string_view text) {
  return fault([&] { parse_obj_text(text); });
}

constexpr std::string_view kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, RoundTripsExactly) {
  MeshSequence clip = awkward_clip(1);
  std::string text;
  append_obj(clip.polygons, clip.positions, text);
  Mesh mesh = parse_obj_text(text);
  EXPECT_EQ(mesh.polygons, clip.polygons);
  ASSERT_EQ(mesh.positions.size(), clip.positions.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_EQ(std::bit_cast<uint32_t>(mesh.positions[i]),
              std::bit_cast<uint32_t>(clip.positions[i]));
}

TEST(ObjDetails, GroupFacesByObjectAndMaterial) {
  MeshSequence clip;
  clip.vertex_count = 3;
  for (int p = 0; p < 4; ++p)
    clip.polygons.add(std::vector<uint32_t>{0, 1, 2});
  clip.parts = {{"ball", "box"}, {1, 0, 1, 0}};
  clip.materials = {{"red"}, {kNoLabel, 0, 0, 0}};
  const std::vector<float> positions(9);
  const auto faces = [&](const ObjDetails& details) {
    std::string text;
    append_obj(clip.polygons, positions, text, &details);
    return text.substr(text.find("o "));
  };
  const std::string face = "f 1 2 3\n";
  EXPECT_EQ(faces(ObjDetails(clip, true)),
            "o box\n" + face + "usemtl red\n" + face + "o ball\n" + face + face);
  EXPECT_EQ(faces(ObjDetails(clip)), "o box\n" + face + "o ball\nusemtl red\n" + face + "o box\n" +
                                         face + "o ball\n" + face);
}

TEST(Obj, ReadsAllFormsOfFaces) {
  Mesh mesh = parse_obj_text(std::string(kThreeVertices) +
                             "vt 0 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\n"
                             "f 1/1/1 2/1/1 3/1/1\nf -3 -2 -1\nf -1/-1/-1 -2/-1/-1 -3/-1/-1\n");
  EXPECT_EQ(mesh.polygons.size(), 6U);
  EXPECT_THAT(mesh.polygons[4], ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.polygons[5], ElementsAre(2, 1, 0));
}

TEST(Obj, SkipsOtherStatementsByName) {
  Mesh mesh = parse_obj_text(
      std::string(kThreeVertices) +
      "mtllib a b.mtl\nusemtl m\no name\ng a b\ns off\nl 1 2\np 1\n"
      "cstype bspline\ndeg 3\nvp 0 1\ncurv 0 1 1 2\nparm u 0 1\nend\nf 1 2 3 # tail\n");
  EXPECT_EQ(mesh.polygons.size(), 1U);
}

TEST(Obj, ReadsAllLineEndsAndContinuations) {
  for (std::string end : {"\n", "\r\n", "\r"}) {
    Mesh mesh =
        parse_obj_text("# c:\\" + end + "v 0 0 \\" + end + " 0" + end + end + "v\t1 0 0  " + end +
                       "v +0 1e0 0" + end + "g a \\" + end + "b" + end + "f 1 2\\" + end + "3");
    EXPECT_EQ(mesh.vertex_count(), 3U);
    EXPECT_EQ(mesh.positions[7], 1.0F);
    ASSERT_EQ(mesh.polygons.size(), 1U);
    EXPECT_THAT(mesh.polygons[0], ElementsAre(0, 1, 2));
  }
}

TEST(Obj, ToleratesWeightsColoursAndByteOrderMark) {
  Mesh mesh = parse_obj_text("\xEF\xBB\xBFv 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 0 1 0 1 1 1 1\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertex_count(), 3U);
}

TEST(Obj, ReadsFacesBeforeTheirVertices) {
  EXPECT_EQ(parse_obj_text("f 1 2 3\n" + std::string(kThreeVertices)).polygons.size(), 1U);
}

TEST(Obj, RoundsTinyNumbersToZeroOrDenormals) {
  Mesh mesh = parse_obj_text("v 1e-45 -1e-60 1e-500\n");
  EXPECT_EQ(mesh.positions[0], 1e-45F);
  EXPECT_EQ(mesh.positions[1], 0.0F);
  EXPECT_TRUE(std::signbit(mesh.positions[1]));
  EXPECT_EQ(mesh.positions[2], 0.0F);
}

TEST(Obj, RejectsNonFiniteCoordinatesNamingLineAndVertex) {
  EXPECT_EQ(obj_fault("v 0 0 0\n\nv 0 nan 0\n"),
            "a.obj:3: coordinate nan of vertex 1 is not finite");
  EXPECT_THAT(obj_fault("v 0 0 -inf\n"), HasSubstr("a.obj:1: coordinate -inf of vertex 0"));
  EXPECT_THAT(obj_fault("v 0 0 1e39\n"), HasSubstr("exceeds the range of 32-bit numbers"));
  EXPECT_THAT(obj_fault("v 0 0 -1e999\n"), HasSubstr("exceeds the range of 32-bit numbers"));
}

TEST(Obj, RejectsJunkNamingTheLine) {
  EXPECT_EQ(obj_fault("v 0 0 0\nhello 1 2\n"), "a.obj:2: unknown statement 'hello'");
  EXPECT_EQ(obj_fault("v 0 0x1 0\n"), "a.obj:1: '0x1' is not a coordinate");
  EXPECT_EQ(obj_fault("v 0 1,5 0\n"), "a.obj:1: '1,5' is not a coordinate");
  EXPECT_EQ(obj_fault("v 0 +-1 0\n"), "a.obj:1: '+-1' is not a coordinate");
  EXPECT_EQ(obj_fault("v 0 0\n"), "a.obj:1: the line ends where a coordinate is expected");
  EXPECT_EQ(obj_fault("v 0 0"), "a.obj:1: the file ends where a coordinate is expected");
  EXPECT_THAT(obj_fault("v 0 0 0 1 1\n"), HasSubstr("a.obj:1: vertex 0 has 5 numbers"));
  EXPECT_THAT(obj_fault("v 0 0 0 red\n"), HasSubstr("'red' is not a number"));
  EXPECT_THAT(obj_fault(std::string_view("v 0 0 \0\n", 8)), HasSubstr(R"(a.obj:1: '\x00' is not)"));
}

TEST(Obj, RejectsBadFacesNamingTheLine) {
  std::string three(kThreeVertices);
  EXPECT_EQ(obj_fault(three + "f 1 2 3\nf 1 2 4\n"),
            "a.obj:5: vertex index 4 is out of range; there are 3 vertices");
  EXPECT_EQ(obj_fault(three + "f 0 1 2\n"),
            "a.obj:4: vertex index 0 is out of range; there are 3 vertices so far");
  EXPECT_EQ(obj_fault(three + "f -4 1 2\n"),
            "a.obj:4: vertex index -4 is out of range; there are 3 vertices so far");
  EXPECT_THAT(obj_fault(three + "f 1 2\n"), HasSubstr("a face of 2 corners"));
  EXPECT_THAT(obj_fault(three + "f 1 2 3x\n"), HasSubstr("a.obj:4: a face corner"));
  EXPECT_THAT(obj_fault(three + "f 1 2 3/\n"), HasSubstr("a.obj:4: "));
  EXPECT_THAT(obj_fault(three + "f 1 2 3/1/1/1\n"), HasSubstr("a.obj:4: a face corner"));
  EXPECT_THAT(obj_fault(three + "f 1 2 1.5\n"), HasSubstr("a.obj:4: a face corner"));
  EXPECT_THAT(obj_fault(three + "f 1 2 99999999999999999999\n"),
              HasSubstr("is not a vertex index"));
}

TEST(Obj, RejectsFilesWithoutVertices) {
  EXPECT_EQ(obj_fault(""), "a.obj: the mesh has no vertex");
  EXPECT_EQ(obj_fault("# nothing\n"), "a.obj: the mesh has no vertex");
}

}  // namespace
}  // namespace anicodec::tools
