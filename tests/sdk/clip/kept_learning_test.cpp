// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/kept_learning.h"

#include <utility>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Vector<LearntSegment> learnt(uint64_t first, uint64_t second) {
  Vector<LearntSegment> of_meshes(2);
  of_meshes[0].identity = first;
  of_meshes[1].identity = second;
  return of_meshes;
}

TEST(KeptLearning, HasTheFileAtHandAndTheOneBefore) {
  KeptLearning kept;
  EXPECT_EQ(kept.find(0, 1), nullptr);
  EXPECT_EQ(kept.latest(0), nullptr);
  kept.keep(learnt(1, 11));
  EXPECT_NE(kept.find(0, 1), nullptr);
  kept.keep(learnt(2, 0));  // nothing of the second mesh
  EXPECT_NE(kept.find(0, 1), nullptr);
  EXPECT_NE(kept.find(1, 11), nullptr);
  EXPECT_EQ(kept.find(0, 11), nullptr);
  kept.keep(learnt(2, 0));  // opened again
  EXPECT_NE(kept.find(0, 1), nullptr);
  EXPECT_EQ(kept.latest(0)->identity, 2U);
  EXPECT_NE(kept.find(0, 2), nullptr);  // by the file that follows
  EXPECT_EQ(kept.find(0, 1), nullptr);
  kept.keep(learnt(3, 12));
  EXPECT_EQ(kept.find(0, 2)->identity, 2U);
  EXPECT_EQ(kept.find(2, 3), nullptr);
  kept.clear();
  EXPECT_EQ(kept.latest(1), nullptr);
}

}  // namespace
}  // namespace anicodec
