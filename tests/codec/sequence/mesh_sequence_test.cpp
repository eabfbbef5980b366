// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/mesh_sequence.h"

#include "codec/sequence/error.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

MeshSequence triangle() {
  MeshSequence s;
  s.vertex_count = 3;
  s.frame_count = 2;
  s.polygons.add(std::vector<uint32_t>{0, 1, 2});
  s.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 3};
  return s;
}

std::string fault(const MeshSequence& s) {
  try {
    check(s);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(MeshSequence, AcceptsATriangle) {
  EXPECT_EQ(fault(triangle()), "");
  EXPECT_DOUBLE_EQ(diagonal(triangle()), std::sqrt(1 + 1 + 9));
}

TEST(MeshSequence, RejectsNonFinitePositionsNamingFrameAndVertex) {
  MeshSequence s = triangle();
  s.positions[9 + 3 * 2 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(fault(s), testing::HasSubstr("frame 1, vertex 2"));
}

TEST(MeshSequence, RejectsCornersOutOfRange) {
  MeshSequence s = triangle();
  s.polygons.corners[1] = 3;
  EXPECT_THAT(fault(s), testing::HasSubstr("face 0 uses vertex 3 of 3"));
}

TEST(MeshSequence, RejectsEmptySequences) {
  MeshSequence s = triangle();
  s.frame_count = 0;
  s.positions.clear();
  EXPECT_NE(fault(s), "");
}

}  // namespace
}  // namespace anicodec
