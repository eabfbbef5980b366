// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/ply.h"

#include "tests/tools/io_testing.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/formats/ply_header.h"

#include <bit>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Mesh parse_ply_text(std::string_view bytes) {
  Mesh mesh;
  parse_ply(bytes, "a.ply", mesh);
  return mesh;
}

std::string ply_fault(std::string_view bytes) {
  return fault([&] { parse_ply_text(bytes); });
}

void expect_same_bits(std::span<const float> a, std::span<const float> b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(std::bit_cast<uint32_t>(a[i]), std::bit_cast<uint32_t>(b[i]));
}

TEST(Ply, RoundTripsExactly) {
  MeshSequence clip = awkward_clip(1);
  for (bool ascii : {true, false}) {
    std::string bytes;
    append_ply(clip.polygons, clip.positions, ascii, bytes);
    Mesh mesh = parse_ply_text(bytes);
    EXPECT_EQ(mesh.polygons, clip.polygons);
    expect_same_bits(mesh.positions, clip.positions);
  }
}

TEST(Ply, RoundTripsPolygonsOfManyCorners) {
  Polygons polygons;
  std::vector<uint32_t> corners(300);
  for (uint32_t i = 0; i < 300; ++i)
    corners[i] = i;
  polygons.add(corners);
  std::vector<float> positions(900, 0.5F);
  for (bool ascii : {true, false}) {
    std::string bytes;
    append_ply(polygons, positions, ascii, bytes);
    EXPECT_EQ(parse_ply_text(bytes).polygons, polygons);
  }
}

// Vertices with properties of all types around doubles in the order z, x, y; an element of lists
// between; faces with an attribute before and a list after the indices.
std::string rich_ply(PlyEncoding encoding) {
  bool ascii = encoding == PlyEncoding::kAscii;
  std::endian order = encoding == PlyEncoding::kBigEndian ? std::endian::big : std::endian::little;
  std::string out = "ply\nformat ";
  out += ascii ? "ascii" : order == std::endian::big ? "binary_big_endian" : "binary_little_endian";
  out +=
      " 1.0\ncomment made by hand\nobj_info none\nelement vertex 3\nproperty char a\n"
      "property double z\nproperty ushort b\nproperty double x\nproperty float64 y\n"
      "element other 2\nproperty list uint double values\nproperty uchar tail\n"
      "element empty 1000000000000\n"
      "element face 2\nproperty short a\nproperty list int16 uint16 vertex_index\n"
      "property list uchar float texcoord\nend_header\n";
  auto put = [&](auto x) {
    if (ascii) {
      out += std::to_string(x) + " ";
    } else {
      append(x, order, out);
    }
  };
  auto end = [&] { out += ascii ? "\n" : ""; };
  for (int v = 0; v < 3; ++v) {
    put(int8_t{-3});
    put(v + 0.25);
    put(uint16_t{65535});
    put(v + 0.5);
    put(v + 0.75);
    end();
  }
  for (uint32_t i = 0; i < 2; ++i) {
    put(i);
    for (uint32_t k = 0; k < i; ++k)
      put(1.5);
    put(uint8_t{200});
    end();
  }
  for (uint16_t f = 0; f < 2; ++f) {
    put(int16_t{-1});
    put(int16_t{3});
    for (uint16_t k = 0; k < 3; ++k)
      put(static_cast<uint16_t>((k + f) % 3));
    put(uint8_t{1});
    put(0.5F);
    end();
  }
  return out;
}

TEST(Ply, SkipsUnknownPropertiesAndElementsInEveryEncoding) {
  for (PlyEncoding encoding :
       {PlyEncoding::kAscii, PlyEncoding::kLittleEndian, PlyEncoding::kBigEndian}) {
    Mesh mesh = parse_ply_text(rich_ply(encoding));
    EXPECT_THAT(mesh.positions,
                ElementsAre(0.5F, 0.75F, 0.25F, 1.5F, 1.75F, 1.25F, 2.5F, 2.75F, 2.25F));
    ASSERT_EQ(mesh.polygons.size(), 2U);
    EXPECT_THAT(mesh.polygons[0], ElementsAre(0, 1, 2));
    EXPECT_THAT(mesh.polygons[1], ElementsAre(1, 2, 0));
  }
}

TEST(Ply, RejectsEveryTruncation) {
  for (PlyEncoding encoding :
       {PlyEncoding::kAscii, PlyEncoding::kLittleEndian, PlyEncoding::kBigEndian}) {
    std::string bytes = rich_ply(encoding);
    // The last number, blank and line end of an ascii file may be cut without a trace.
    size_t untraceable = encoding == PlyEncoding::kAscii ? 10 : 0;
    for (size_t size = 0; size + untraceable < bytes.size(); ++size)
      EXPECT_THAT(ply_fault(bytes.substr(0, size)), HasSubstr("a.ply")) << size;
  }
}

std::string ascii_ply(const std::string& vertices, const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

constexpr const char* kThreeLines = "0 0 0\n1 0 0\n0 1 0\n";

TEST(Ply, RejectsBadAsciiBodiesNamingTheLine) {
  EXPECT_EQ(ply_fault(ascii_ply(kThreeLines, "3 0 1 3\n")),
            "a.ply:13: vertex index 3 is out of range; there are 3 vertices");
  EXPECT_EQ(ply_fault(ascii_ply(kThreeLines, "3 0 1 -1\n")),
            "a.ply:13: vertex index -1 is out of range; there are 3 vertices");
  EXPECT_EQ(ply_fault(ascii_ply("0 0 0\n0 nan 0\n0 0 0\n", "3 0 1 2\n")),
            "a.ply:11: coordinate nan of vertex 1 is not finite");
  EXPECT_EQ(ply_fault(ascii_ply("0 0 0\n0 0\n0 0 0\n", "3 0 1 2\n")),
            "a.ply:11: the line ends where a coordinate is expected");
  EXPECT_EQ(ply_fault(ascii_ply("0 0 0\n0 0 0 9\n0 0 0\n", "3 0 1 2\n")),
            "a.ply:11: unexpected '9'");
  EXPECT_EQ(ply_fault(ascii_ply(kThreeLines, "")),
            "a.ply:13: the file ends after 0 of 1 elements 'face'");
  EXPECT_THAT(ply_fault(ascii_ply(kThreeLines, "3 0 1 2\n7\n")),
              HasSubstr("a.ply:14: unexpected '7'"));
  EXPECT_THAT(ply_fault(ascii_ply(kThreeLines, "2 0 1\n")), HasSubstr("a face of 2 corners"));
  EXPECT_THAT(ply_fault(ascii_ply(kThreeLines, "3 0 1 1.5\n")), HasSubstr("unexpected '.5'"));
}

TEST(Ply, RejectsBadBinaryBodies) {
  MeshSequence clip = awkward_clip(1);
  clip.positions[7] = std::numeric_limits<float>::quiet_NaN();
  std::string bytes;
  append_ply(clip.polygons, clip.positions, false, bytes);
  EXPECT_EQ(ply_fault(bytes), "a.ply: a coordinate of vertex 2 is not finite");
  clip.positions[7] = 0;
  clip.polygons.corners[0] = 10;
  bytes.clear();
  append_ply(clip.polygons, clip.positions, false, bytes);
  EXPECT_EQ(ply_fault(bytes),
            "a.ply: face 0: vertex index 10 is out of range; there are 10 vertices");
  clip.polygons.corners[0] = 0;
  bytes.clear();
  append_ply(clip.polygons, clip.positions, false, bytes);
  size_t size = bytes.size();
  EXPECT_EQ(ply_fault(bytes.substr(0, size - 1)),
            "a.ply: truncated: face 6 of 7 needs at least " + std::to_string(size) +
                " bytes, the file has " + std::to_string(size - 1));
  EXPECT_EQ(ply_fault(bytes + "x"), "a.ply: the elements end at byte " + std::to_string(size) +
                                        ", but the file has " + std::to_string(size + 1) +
                                        " bytes");
}

std::string header_fault(const std::string& lines) {
  return ply_fault("ply\n" + lines + "end_header\n");
}

TEST(Ply, RejectsBadHeaders) {
  EXPECT_THAT(ply_fault(""), HasSubstr("is not a PLY file"));
  EXPECT_THAT(ply_fault("plywood\n"), HasSubstr("is not a PLY file"));
  EXPECT_THAT(ply_fault("ply\nformat ascii 1.0\n"), HasSubstr("no end_header"));
  EXPECT_EQ(header_fault(""), "a.ply:2: the header names no format");
  EXPECT_EQ(header_fault("format ascii 2.0\n"), "a.ply:2: version '2.0' is not 1.0");
  EXPECT_EQ(header_fault("format text 1.0\n"), "a.ply:2: unknown format 'text'");
  EXPECT_EQ(header_fault("property int x\n"), "a.ply:2: a property comes before the first element");
  EXPECT_EQ(header_fault("element a -1\n"), "a.ply:2: the count -1 is negative");
  EXPECT_EQ(header_fault("element a 1 2\n"), "a.ply:2: unexpected '2'");
  EXPECT_EQ(header_fault("element a 1\nelement a 1\n"), "a.ply:3: 'a' is declared twice");
  EXPECT_EQ(header_fault("element a 1\nproperty int x\nproperty int x\n"),
            "a.ply:4: 'x' is declared twice");
  EXPECT_EQ(header_fault("element a 1\nproperty half x\n"), "a.ply:3: unknown type 'half'");
  EXPECT_EQ(header_fault("element a 1\nproperty list float int x\n"),
            "a.ply:3: the count of a list is not an integer type");
  EXPECT_EQ(header_fault("nonsense\n"), "a.ply:2: unknown header line 'nonsense'");
  EXPECT_THAT(header_fault("format ascii 1.0\nelement vertex 1\nproperty float x\n"),
              HasSubstr("no coordinate y"));
  EXPECT_THAT(
      header_fault("format ascii 1.0\nelement face 1\nproperty list int float vertex_index\n"),
      HasSubstr("no list vertex_indices"));
  EXPECT_THAT(header_fault("format ascii 1.0\nelement tristrips 1\nproperty list int int a\n"),
              HasSubstr("triangle strips"));
  EXPECT_THAT(header_fault("format ascii 1.0\n"), HasSubstr("has no vertex"));
  EXPECT_THAT(header_fault("format binary_big_endian 1.0\nelement vertex 2000000000\n"
                           "property float x\nproperty float y\nproperty float z\n"),
              HasSubstr("truncated: vertex 0 of 2000000000 needs at least 6000000121 bytes"));
}

TEST(Ply, FindsTheBodyAfterAnyLineEnd) {
  MeshSequence clip = awkward_clip(1);
  std::string bytes;
  append_ply(clip.polygons, clip.positions, false, bytes);
  size_t body = bytes.find("end_header\n") + 11;
  for (std::string end : {"\r\n", "\r"}) {
    std::string header;
    for (char c : bytes.substr(0, body))
      header += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(parse_ply_text(header + bytes.substr(body)).polygons, clip.polygons);
  }
}

}  // namespace
}  // namespace anicodec::tools
