// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/frame_normals.h"

#include "corpus/clips.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Two triangles that meet in an edge at a right angle.
MeshSequence folded() {
  MeshSequence clip;
  clip.vertex_count = 4;
  clip.frame_count = 1;
  clip.positions = {0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};
  for (const std::vector<uint32_t>& triangle : {std::vector<uint32_t>{0, 2, 1}, {0, 1, 3}})
    clip.polygons.add(triangle);
  return clip;
}

TEST(FrameNormals, AreSmoothWhereNothingIsKnown) {
  const MeshSequence clip = folded();
  const FrameNormals normals(clip);
  ASSERT_EQ(normals.size(), 4U);
  const std::vector<float> n = normals.compute(clip.frame(0));
  const float half = std::sqrt(0.5F);
  const float* at = n.data() + size_t{3} * normals.of_corner(0);
  EXPECT_NEAR(at[0], half, 1e-6);
  EXPECT_NEAR(at[1], 0, 1e-6);
  EXPECT_NEAR(at[2], half, 1e-6);
  EXPECT_EQ(normals.of_corner(0), normals.of_corner(3));
}

TEST(FrameNormals, AreHardWhereTheClipSaysSo) {
  MeshSequence clip = folded();
  clip.shared_normals = {70, 80, 90, 7, 8, 9};
  const FrameNormals normals(clip);
  ASSERT_EQ(normals.size(), 6U);
  const std::vector<float> n = normals.compute(clip.frame(0));
  for (uint32_t c = 0; c < 6; ++c) {
    const float* at = n.data() + size_t{3} * normals.of_corner(c);
    EXPECT_NEAR(at[c < 3 ? 2 : 0], 1, 1e-6) << c;
  }
}

TEST(NormalError, IsTheAngleByWhichAClipIsTurned) {
  const MeshSequence clip = corpus::make_clip("limb");
  MeshSequence other = clip;
  constexpr double kAngle = 3 * 3.14159265358979 / 180;
  const auto c = static_cast<float>(std::cos(kAngle)), s = static_cast<float>(std::sin(kAngle));
  for (size_t i = 0; i < other.positions.size(); i += 3) {
    const float y = clip.positions[i + 1], z = clip.positions[i + 2];
    other.positions[i + 1] = c * y - s * z;
    other.positions[i + 2] = s * y + c * z;
  }
  EXPECT_LT(normal_error(clip, frames_of(clip), frames_of(clip)).max, 1e-4);
  const NormalError error = normal_error(clip, frames_of(clip), frames_of(other));
  EXPECT_LT(error.max, 3.01);
  EXPECT_GT(error.max, 2.9);
  EXPECT_GT(error.mean, 0.5);
}

}  // namespace
}  // namespace anicodec
