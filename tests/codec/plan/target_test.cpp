// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/plan/target.h"

#include "codec/sequence/error.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(Target, APercentageIsOfTheDiagonal) {
  EXPECT_DOUBLE_EQ(bound_of({ErrorMetric::kRmse, 0.5, true}, 20).value, 0.1);
  EXPECT_EQ(bound_of({ErrorMetric::kRmse, 0.5, false}, 20).value, 0.5);
  EXPECT_EQ(bound_of({ErrorMetric::kMaxError, 0, false}, 20).value, 0);
  EXPECT_THROW(bound_of({ErrorMetric::kRmse, 0, false}, 20), Error);
  EXPECT_THROW(bound_of({ErrorMetric::kKg, -1, false}, 20), Error);
}

TEST(Target, EachClipTakesAPercentageOfItsOwn) {
  const Target cap{ErrorMetric::kMaxError, 10, true};
  const std::vector<ClipGoal> goals =
      clip_goals({ErrorMetric::kRmse, 1, true}, cap, {4, 0, 2}, 100);
  ASSERT_EQ(goals.size(), 3U);
  EXPECT_DOUBLE_EQ(goals[0].bound.value, 0.04);
  EXPECT_DOUBLE_EQ(goals[1].bound.value, 0.02);  // a point: as the smallest of the others
  EXPECT_DOUBLE_EQ(*goals[2].cap, 0.2);
  EXPECT_EQ(largest_bound(goals).value, goals[0].bound.value);
  EXPECT_DOUBLE_EQ(clip_goals({ErrorMetric::kRmse, 1, true}, {}, {0}, 100)[0].bound.value, 1);
}

TEST(Target, AGoalHasACeiling) {
  ClipGoal goal{{ErrorMetric::kMaxError, 1e38}, 1e30, 1};
  limit_goal(2, &goal);
  EXPECT_EQ(goal.bound.value, 2e6);
  EXPECT_EQ(goal.cap, 2e6);
}

TEST(Target, IsKeptByWhatWasMeasured) {
  FileMeasures file;
  file.kg = 0.1;
  file.max_error = 2;
  file.bytes = 100;
  file.vertices = 10;
  file.frames = 8;
  EXPECT_TRUE(is_kept({{ErrorMetric::kKg, 0.1}, {}, 0}, file));
  EXPECT_FALSE(is_kept({{ErrorMetric::kKg, 0.1}, 1.0, 0}, file));
  EXPECT_TRUE(is_kept({{ErrorMetric::kBpfv, 10}, {}, 0}, file));
  EXPECT_FALSE(is_kept({{ErrorMetric::kBpfv, 9.9}, {}, 0}, file));
}

}  // namespace
}  // namespace anicodec
