// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/triangle_axes.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Corners = Vector3[3];

void expect_axes(const TriangleAxes& axes) {
  EXPECT_NEAR(length(axes.normal), 1, 1e-12);
  EXPECT_NEAR(length(axes.tangent), 1, 1e-12);
  EXPECT_NEAR(dot(axes.normal, axes.tangent), 0, 1e-6);
}

TEST(TriangleAxes, StandOnTheFrontAndFollowTheFirstEdge) {
  const Corners corners = {{{1, 2, 3}}, {{3, 2, 3}}, {{1, 5, 3}}};
  const TriangleAxes axes(corners);
  EXPECT_EQ(axes.normal[2], 1);
  EXPECT_EQ(axes.tangent[0], 1);
  expect_axes(axes);
}

TEST(TriangleAxes, AreAxesWithoutAnArea) {
  const Corners odd[] = {{{{1, 1, 1}}, {{1, 1, 1}}, {{1, 1, 1}}},
                         {{{0, 0, 0}}, {{1, 2, 3}}, {{2, 4, 6}}},
                         {{{5, 5, 5}}, {{5, 5, 5}}, {{5, 7, 5}}},
                         {{{0, 0, 0}}, {{1e-38, 0, 0}}, {{0, 1e-38, 0}}},
                         {{{0, 0, 0}}, {{3e38, 0, 0}}, {{0, 3e38, 0}}},
                         {{{0, 0, 0}}, {{1, 0, 0}}, {{0.5, 1e-30, 0}}}};
  for (const Corners& corners : odd)
    expect_axes(TriangleAxes(corners));
}

}  // namespace
}  // namespace anicodec
