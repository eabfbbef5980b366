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
  sort_naturally(names);
  EXPECT_THAT(names,
              testing::ElementsAre("f_1.obj", "f_2.obj", "f_10.obj", "f_20.obj", "f_100.obj"));
}

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::ranges::sort(names);
  sort_naturally(names);
  return names;
}

TEST(NaturalOrder, CountsBelowZero) {
  const std::vector<std::string> names = {"sim.-0010.obj", "sim.-0009.obj", "sim.0000.obj",
                                          "sim.0001.obj", "sim.0010.obj"};
  EXPECT_EQ(sorted(names), names);
  const std::vector<std::string> dashes = {"walk-1.obj", "walk-2.obj", "walk-10.obj"};  // no signs
  EXPECT_EQ(sorted(dashes), dashes);
}

TEST(NaturalOrder, CountsPartsOfFrames) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"sim.1.obj", "sim.1.25.obj", "sim.1.5.obj", "sim.1.75.obj",
                                 "sim.2.obj"},
        {"sim.-1.5.obj", "sim.-1.obj", "sim.-0.5.obj", "sim.0.obj", "sim.0.5.obj"},
        {"f_1.25.obj", "f_1.5.obj", "f_2.125.obj", "f_2.5.obj"},
        {"take.1.9.obj", "take.1.10.obj", "take.1.100.obj"},
        {"take.1.9.obj", "take.1.10.obj", "take.2.9.obj", "take.2.10.obj"},
        {"v1.2_f.9.obj", "v1.2_f.10.obj"}})
    EXPECT_EQ(sorted(names), names);
}

TEST(NaturalOrder, IsAStrictOrder) {
  std::vector<std::string> ordered = {"",
                                      "-2",
                                      "-1",
                                      "--5",
                                      "--1",
                                      "-a",
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
