// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/guard/guard_message.h"

#include "tests/tools/io_testing.h"

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

std::string made_message() {
  std::string message;
  append_one(uint8_t{7}, message);
  append_values(std::string("text"), message);
  append_values(std::vector<float>{1, 2, 3}, message);
  append_values(std::vector<uint32_t>(), message);
  return message;
}

void read_all(std::string_view bytes) {
  GuardMessage in(bytes, "x.fbx");
  EXPECT_EQ(in.one<uint8_t>(), 7);
  EXPECT_EQ(in.text(), "text");
  std::vector<float> numbers;
  in.values(numbers);
  EXPECT_THAT(numbers, testing::ElementsAre(1, 2, 3));
  std::vector<uint32_t> none = {1};
  in.values(none);
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(in.at_end());
}

TEST(GuardMessage, GivesWhatWasAppended) {
  read_all(made_message());
}

TEST(GuardMessage, TrustsNoSize) {
  const std::string message = made_message();
  for (size_t size = 0; size < message.size(); ++size) {
    EXPECT_EQ(fault([&] { read_all(std::string_view(message).substr(0, size)); }),
              "x.fbx: the process that reads it says nothing that makes sense")
        << size;
  }
  std::string endless;
  append_one(UINT64_MAX / 4 + 1, endless);  // times the size of a float: 2^64
  std::vector<float> numbers;
  EXPECT_THAT(fault([&] { GuardMessage(endless, "x").values(numbers); }),
              testing::HasSubstr("makes sense"));
}

}  // namespace
}  // namespace anicodec::tools
