// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/signed_axes.h"

#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

const std::vector<float> kPoints = {0, 0, 0, 1, 2, 3, -4, 1, 0.5F, 2, -2, 1};

std::vector<float> turned(const SignedAxes& axes, float scale) {
  std::vector<float> out;
  for (size_t i = 0; i < kPoints.size(); i += 3) {
    for (const SignedAxis& axis : axes)
      out.push_back(scale * axis.sign * kPoints[i + axis.axis]);
  }
  return out;
}

TEST(SignedAxes, AreFound) {
  const SignedAxes up = {{{0, 1}, {2, -1}, {1, 1}}};
  EXPECT_EQ(text_of(up), "x,-z,y");
  const std::optional<ScaledTurn> turn = find_turn(kPoints, turned(up, 100));
  ASSERT_TRUE(turn);
  EXPECT_EQ(turn->axes, up);
  EXPECT_NEAR(turn->scale, 100, 1e-3);
  EXPECT_EQ(find_turn(kPoints, kPoints)->axes, kSameAxes);
}

TEST(SignedAxes, AreTwentyFourTurnsAndNoMirrorImage) {
  size_t found = 0;
  for (size_t a = 0; a < 3; ++a) {
    for (size_t b = 0; b < 3; ++b) {
      for (unsigned signs = 0; a != b && signs < 8; ++signs) {
        SignedAxes axes = {{{a, 1}, {b, 1}, {3 - a - b, 1}}};
        for (size_t k = 0; k < 3; ++k)
          axes[k].sign = (signs >> k & 1) != 0 ? -1.0F : 1.0F;
        const std::optional<ScaledTurn> turn = find_turn(kPoints, turned(axes, 1));
        found += turn.has_value();
        if (turn) {
          EXPECT_EQ(turn->axes, axes) << text_of(axes);
        }
      }
    }
  }
  EXPECT_EQ(found, 24U);
}

TEST(SignedAxes, AreNotFoundForAnotherShape) {
  std::vector<float> other = kPoints;
  other[4] += 0.1F;
  EXPECT_FALSE(find_turn(kPoints, other));
  EXPECT_FALSE(find_turn(std::vector<float>(12), kPoints));
  EXPECT_FALSE(find_turn({}, {}));
}

}  // namespace
}  // namespace anicodec::tools
