// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/word_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(WordList, IsSplitAtCommas) {
  EXPECT_THAT(split_at_commas("walk,run fast,idle"), ElementsAre("walk", "run fast", "idle"));
  EXPECT_THAT(split_at_commas("walk"), ElementsAre("walk"));
  EXPECT_THAT(split_at_commas("walk,,"), ElementsAre("walk", "", ""));
  EXPECT_THAT(split_at_commas(""), IsEmpty());
}

}  // namespace
}  // namespace anicodec::tools
