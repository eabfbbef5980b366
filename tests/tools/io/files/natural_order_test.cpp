// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/files/natural_order.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

TEST(NaturalOrder, CountsNumbersByValue) {
  std::vector<std::string> names = {"f_10.obj", "f_2.obj", "f_1.obj", "f_100.obj", "f_20.obj"};
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_THAT(names,
              testing::ElementsAre("f_1.obj", "f_2.obj", "f_10.obj", "f_20.obj", "f_100.obj"));
}

TEST(NaturalOrder, IsAStrictOrder) {
  std::vector<std::string> ordered = {"",
                                      "0",
                                      "00",
                                      "1",
                                      "1a",
                                      "01a",
                                      "2",
                                      "10",
                                      "a",
                                      "a0b1",
                                      "a00b1",
                                      "a0b2",
                                      "a1",
                                      "a01",
                                      "a1b",
                                      "a99999999999999999999998",
                                      "a99999999999999999999999",
                                      "b"};
  for (size_t i = 0; i < ordered.size(); ++i) {
    for (size_t j = 0; j < ordered.size(); ++j)
      EXPECT_EQ(natural_less(ordered[i], ordered[j]), i < j) << ordered[i] << " " << ordered[j];
  }
}

}  // namespace
}  // namespace anicodec::tools
