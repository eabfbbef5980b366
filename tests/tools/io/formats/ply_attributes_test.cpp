// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/ply_attributes.h"

#include "tests/tools/clip_testing.h"
#include "tests/tools/command_testing.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(PlyAttributes, TakeColoursCoordinatesNormalsAndNumbersByTheirNames) {
  TemporaryFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property ushort red\nproperty ushort green\nproperty ushort blue\nproperty float s\n"
      "property float t\nproperty double quality\nproperty list uchar int rings\n"
      "property float broken\nelement face 1\nproperty list uchar int vertex_indices\n"
      "end_header\n";
  folder.write("a.ply", header +
                            "0 0 0 0 0 1 65535 0 0 0.25 0.5 7.5 2 1 2 nan\n"
                            "1 0 0 0 0 1 0 65535 0 0.5 0.5 -1 0 2\n"
                            "0 1 0 0 0 1 0 0 13107 0.75 0.5 3 1 1 4\n3 0 1 2\n");
  const MeshSequence clip = load_file(folder / "a.ply");
  ASSERT_EQ(clip.attributes.size(), 4U);  // what is not finite is left out
  EXPECT_EQ(find_attribute(clip, AttributeKind::kColour)->values,
            (FrameArray{1, 0, 0, 0, 1, 0, 0, 0, 0.2F}));
  EXPECT_EQ(find_attribute(clip, AttributeKind::kUv)->values,
            (FrameArray{0.25F, 0.5F, 0.5F, 0.5F, 0.75F, 0.5F}));
  EXPECT_EQ(find_attribute(clip, AttributeKind::kNormal)->components, 3U);
  EXPECT_EQ(find_attribute(clip, AttributeKind::kCustom)->name, "quality");
  EXPECT_EQ(find_attribute(clip, AttributeKind::kCustom)->values, (FrameArray{7.5F, -1, 3}));
}

}  // namespace
}  // namespace anicodec::tools
