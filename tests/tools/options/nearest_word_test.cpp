// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/options/nearest_word.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

const std::vector<std::string> kWords = {"--max-error", "--mesh", "--rmse", "encode", "decode"};

TEST(NearestWord, ForgivesALetterInThree) {
  EXPECT_EQ(nearest_word("--max_error", kWords), "--max-error");
  EXPECT_EQ(nearest_word("--max-eror", kWords), "--max-error");
  EXPECT_EQ(nearest_word("--rmes", kWords), "--rmse") << "swapped letters";
  EXPECT_EQ(nearest_word("encod", kWords), "encode");
  EXPECT_EQ(nearest_word("enocde", kWords), "encode");
}

TEST(NearestWord, KnowsWhenNothingIsNear) {
  EXPECT_EQ(nearest_word("--colour", kWords), "");
  EXPECT_EQ(nearest_word("compress", kWords), "");
  EXPECT_EQ(nearest_word("", kWords), "");
  EXPECT_EQ(nearest_word(std::string(100000, 'e'), kWords), "");
}

}  // namespace
}  // namespace anicodec::tools
