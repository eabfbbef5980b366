// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/progress_line.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A terminal that keeps what is printed, with a clock that is set by hand.
class ProgressLineTest : public testing::Test {
 protected:
  ProgressLineTest() : stream_(::open_memstream(&text_, &size_)) {}

  ~ProgressLineTest() override {
    std::fclose(stream_);
    std::free(text_);
  }

  ProgressLine::Clock clock() {
    return [this] { return now_; };
  }

  std::string printed() {
    std::fflush(stream_);
    return {text_, size_};
  }

  double now_ = 100;
  char* text_ = nullptr;
  size_t size_ = 0;
  std::FILE* stream_;
};

TEST_F(ProgressLineTest, IsSilentForASecond) {
  ProgressLine line(stream_, clock());
  now_ += 0.9;
  line.show("reading", 0.9);
  EXPECT_EQ(printed(), "");
  now_ += 0.2;
  line.show("reading", 0.95);
  EXPECT_THAT(printed(), HasSubstr("reading  95 %"));
}

TEST_F(ProgressLineTest, SaysNoHundredWhileSomethingIsLeft) {
  ProgressLine line(stream_, clock());
  line.show("fitting", 0);
  now_ += 30;
  line.show("fitting", 0.999);
  EXPECT_THAT(printed(), HasSubstr("fitting  99 %, 0:01 left"));
  now_ += 1;
  line.show("fitting", 1);
  EXPECT_THAT(printed(), HasSubstr("fitting 100 %\033"));
}

TEST_F(ProgressLineTest, SaysTheTimeLeftOfTheStage) {
  ProgressLine line(stream_, clock());
  now_ += 50;
  line.show("fitting", 0);
  now_ += 30;
  line.show("fitting", 0.25);
  EXPECT_THAT(printed(), HasSubstr("fitting  25 %, 1:30 left"));
}

TEST_F(ProgressLineTest, IsNotShownMoreOftenThanTenTimesASecond) {
  ProgressLine line(stream_, clock());
  now_ += 2;
  line.show("fitting", 0.50);
  now_ += 0.05;
  line.show("fitting", 0.51);
  EXPECT_THAT(printed(), Not(HasSubstr("51")));
}

TEST_F(ProgressLineTest, RemovesItsLineAtTheEnd) {
  {
    ProgressLine line(stream_, clock());
    now_ += 2;
    line.show("fitting", 0.5);
  }
  EXPECT_TRUE(printed().ends_with("\r\033[K")) << printed();
}

TEST_F(ProgressLineTest, PrintsNothingWhenNothingWasShown) {
  { ProgressLine line(stream_, clock()); }
  EXPECT_EQ(printed(), "");
}

TEST_F(ProgressLineTest, IsEmptyWhenQuiet) {
  ProgressLine line(true);
  EXPECT_FALSE(line.callback());
}

}  // namespace
}  // namespace anicodec::tools
