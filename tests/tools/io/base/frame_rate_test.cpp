// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/frame_rate.h"

#include "tests/tools/io_testing.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;

std::string shown(const FrameRate& rate) {
  return std::to_string(rate.numerator) + "/" + std::to_string(rate.denominator) +
         (rate.assumed ? " assumed" : "");
}

TEST(FrameRate, ParsesRationalsAndDecimals) {
  EXPECT_EQ(shown(parse_frame_rate("24")), "24/1");
  EXPECT_EQ(shown(parse_frame_rate("30000/1001")), "30000/1001");
  EXPECT_EQ(shown(parse_frame_rate("50/2")), "25/1");
  EXPECT_EQ(shown(parse_frame_rate("12.5")), "25/2");
  EXPECT_EQ(shown(parse_frame_rate("24.0")), "24/1");
  EXPECT_EQ(shown(parse_frame_rate("0.1")), "1/10");
  EXPECT_EQ(shown(parse_frame_rate("23.976")), "24000/1001");
  EXPECT_EQ(shown(parse_frame_rate("23.98")), "24000/1001");
  EXPECT_EQ(shown(parse_frame_rate("29.97")), "30000/1001");
  EXPECT_EQ(shown(parse_frame_rate("59.94")), "60000/1001");
}

TEST(FrameRate, RejectsWhatIsNoRate) {
  for (const char* text : {"", "0", "24/0", "-24", "24/", "/24", "24/1/1", "nan", "1e3", "24fps",
                           ".5", "5.", "4294967296", " 24", "0.0", "99999999999999999999"})
    EXPECT_THAT(fault([&] { parse_frame_rate(text); }, ErrorKind::kUsage),
                HasSubstr("is not a frame rate"))
        << text;
}

std::vector<float> times(double fps, size_t frames, double start = 0) {
  std::vector<float> all;
  for (size_t f = 0; f < frames; ++f)
    all.push_back(static_cast<float>(start + static_cast<double>(f) / fps));
  return all;
}

TEST(FrameRate, SnapsTimesToRationals) {
  struct Case {
    double fps;
    const char* rate;
  };

  for (auto [fps, rate] :
       {Case{24, "24/1"}, Case{25, "25/1"}, Case{30, "30/1"}, Case{60, "60/1"}, Case{1, "1/1"},
        Case{24000 / 1001.0, "24000/1001"}, Case{30000 / 1001.0, "30000/1001"},
        Case{60000 / 1001.0, "60000/1001"}, Case{23.976, "24000/1001"}, Case{29.97, "30000/1001"},
        Case{12.5, "25/2"}, Case{0.1, "1/10"}, Case{100.0 / 3, "100/3"}, Case{1000, "1000/1"}}) {
    for (size_t frames : {2U, 3U, 48U, 1000U}) {
      for (double start : {0.0, 1.5}) {
        Timing timing = timing_of(times(fps, frames, start), "a.mdd");
        EXPECT_EQ(shown(timing.rate), rate) << frames << " frames from " << start;
        EXPECT_EQ(timing.start_time, start);
        EXPECT_TRUE(timing.times.empty());
      }
    }
  }
}

TEST(FrameRate, KeepsUnevenTimesFromTheStart) {
  Timing timing = timing_of(std::vector<float>{1, 1.25F, 2, 2.5F}, "a.mdd");
  EXPECT_THAT(timing.times, testing::ElementsAre(0, 0.25, 1, 1.5));
  EXPECT_EQ(timing.start_time, 1);
  EXPECT_EQ(shown(timing.rate), "2/1");
}

TEST(FrameRate, AssumesTheRateOfASingleFrame) {
  Timing timing = timing_of(std::vector<float>{3}, "a.mdd");
  EXPECT_EQ(shown(timing.rate), "24/1 assumed");
  EXPECT_EQ(timing.start_time, 3);
}

TEST(FrameRate, SurvivesExtremeTimes) {
  EXPECT_EQ(timing_of(std::vector<float>{0, 1e-45F}, "").rate.denominator, 1U);
  EXPECT_GT(timing_of(std::vector<float>{-3e38F, 3e38F}, "").rate.numerator, 0U);
}

TEST(FrameRate, RejectsTimesThatDoNotIncrease) {
  EXPECT_THAT(fault([] {
                timing_of(std::vector<float>{0, 1, 1}, "a.mdd");
              }),
              HasSubstr("a.mdd: the time of frame 2 is not after"));
  EXPECT_THAT(fault([] {
                timing_of(std::vector<float>{0, NAN}, "a.mdd");
              }),
              HasSubstr("a.mdd: the time of frame 1 is not finite"));
}

TEST(GridRate, IsTheRateOfTheSmallestGap) {
  const auto rate = [](std::vector<double> times) {
    return grid_rate(times, 1e-7).value_or(FrameRate{1, 1000, false}).value();
  };
  EXPECT_EQ(rate({0, 0.04, 0.2, 0.96}), 25);
  EXPECT_EQ(rate({3, 3.04, 3.2}), 25);
  EXPECT_EQ(rate({0, 1.0 / 12, 0.5}), 12);
  EXPECT_EQ(rate({0, 0.25, 1}), 32) << "four keys a second are no frames";
  EXPECT_EQ(rate({0, 0.5, 2}), 30);
  EXPECT_EQ(rate({0, 2 / 24.0, 5 / 24.0}), 24) << "no key but the first on frame 1";
  EXPECT_EQ(rate({0, 0.5, 0.5001, 1}), 30) << "a hard cut";
  EXPECT_NEAR(rate({0, 1001 / 24000.0, 4004 / 24000.0}), 24000 / 1001.0, 1e-4);
  EXPECT_FALSE(grid_rate(std::vector<double>{0, 0.3137, 1.0071}, 1e-7));
  EXPECT_FALSE(grid_rate(std::vector<double>{0.5}, 1e-7));
  EXPECT_FALSE(grid_rate({}, 1e-7));
}

TEST(CoveringRate, EndsOnAFrame) {
  EXPECT_EQ(covering_rate(2, 30).value(), 30);
  const FrameRate rate = covering_rate(1.0071, 30);
  EXPECT_GE(rate.value(), 30);
  EXPECT_NEAR(1.0071 * rate.value(), 31, 1e-3);
  EXPECT_NEAR(0.001 * covering_rate(0.001, 30).value(), 1, 1e-3);
  EXPECT_EQ(covering_rate(1e-30, 30).value(), 4294967295.0) << "the largest there is";
}

}  // namespace
}  // namespace anicodec::tools
