// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/ply_corners.h"

#include "tests/tools/clip_testing.h"
#include "tests/tools/io_testing.h"
#include "tools/io/load_sequence.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(PlyCorners, TakeCoordinatesAndColoursOfFaces) {
  TemporaryFolder folder;
  folder.write("a.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
               "y\nproperty float z\n"
               "property list uchar int rings\nelement face 3\nproperty list uchar float texcoord\n"
               "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
               "property uchar blue\nproperty uchar alpha\nproperty float quality\n"
               "property list uchar float color\nproperty list uchar float broken\n"
               "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
               "0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\n"
               "0 3 0 1 2 255 0 0 51 0.5 0 0\n"
               "6 0 0 0.25 0 0 0.5 3 1 3 2 0 255 0 255 0.5 9 1 0 0 0 1 0 0 0 1 1 7\n"
               "8 1 1 2 2 3 3 4 4 4 0 1 3 2 0 0 255 255 0.5 12 1 1 1 1 1 1 1 1 1 1 1 1 0\n0 1\n");
  const MeshSequence clip = load_file(folder / "a.ply");
  ASSERT_EQ(clip.attributes.size(), 3U);
  EXPECT_EQ(find_attribute(clip, AttributeKind::kUv)->values,
            (FrameArray{0, 0, 0, 0, 0, 0, 0, 0, 0.25F, 0, 0, 0.5F, 1, 1, 2, 2, 3, 3, 4, 4}));
  const Attribute& corners = clip.attributes[1];
  EXPECT_EQ(corners.name, "wedge_colour");
  EXPECT_EQ(corners.components, 3U);
  EXPECT_EQ(corners.values, (FrameArray{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0,
                                        0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  const Attribute& faces = clip.attributes[2];
  EXPECT_EQ(faces.name, "face_colour");
  EXPECT_EQ(faces.components, 4U);
  ASSERT_EQ(faces.values.size(), 40U);
  for (size_t c = 0; c < 10; ++c)
    EXPECT_EQ(faces.values[4 * c + (c < 3 ? 0 : c < 6 ? 1 : 2)], 1) << c;
  EXPECT_EQ(faces.values[3], 0.2F);
  std::string notes;
  LoadOptions options;
  options.note = [&](const std::string& text) { notes += text; };
  load_sequence(std::vector<std::string>{folder / "a.ply"}, options);
  EXPECT_EQ(
      notes,
      folder /
          "a.ply: left out: 'rings' of vertices, 'quality' of faces, 'broken' of faces, 'edge'");
}

TEST(PlyCorners, LeaveOutListsThatFitNoFace) {
  TemporaryFolder folder;
  folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "property list uchar float color\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5 0 0 0 0 0 9 1 1 1 1 nan 1 1 1 1\n");
  EXPECT_TRUE(load_file(folder / "a.ply").attributes.empty());
}

}  // namespace
}  // namespace anicodec::tools
