// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/scene_goals.h"

#include "codec/sequence/scene.h"
#include "tests/two_boxes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(SceneGoals, AreThoseOfTheWhole) {
  const Scene scene = split_parts(two_boxes());
  const SceneExtent extent = extent_of(scene);
  EXPECT_NEAR(extent.diagonal, diagonal(two_boxes()), 1e-6);
  EXPECT_EQ(shared_goal({ErrorMetric::kMaxError, 1, true}, {}, extent).bound.value,
            extent.diagonal / 100);
  const Bound of_kg = shared_goal({ErrorMetric::kKg, 0.1, false}, {}, extent).bound;
  EXPECT_EQ(of_kg.metric, ErrorMetric::kRmse);
  EXPECT_DOUBLE_EQ(of_kg.value, 0.001 * std::sqrt(extent.spread / extent.positions));
}

}  // namespace
}  // namespace anicodec
