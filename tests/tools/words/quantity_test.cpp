// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/words/quantity.h"

#include "tests/tools/io_testing.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

template <typename Parse>
std::string usage_fault(Parse parse) {
  return fault(parse, ErrorKind::kUsage);
}

TEST(Quantity, ReadsLengths) {
  EXPECT_EQ(parse_length("0.02", "-x").value, 0.02);
  EXPECT_FALSE(parse_length("0.02", "-x").percent);
  EXPECT_EQ(parse_length("0.05%", "-x").value, 0.05);
  EXPECT_TRUE(parse_length("0.05%", "-x").percent);
  EXPECT_EQ(parse_length("1e-3", "-x").value, 0.001);
  EXPECT_EQ(parse_length("5mm", "-x").value, 5);
  EXPECT_DOUBLE_EQ(parse_length("5mm", "-x").in_scene_units(0.01, "-x").value, 0.5);
  EXPECT_EQ(parse_length("5mm", "-x").in_scene_units(0.01, "-x").metres, 0);
  EXPECT_EQ(parse_length("2", "-x").in_scene_units(0, "-x").value, 2);
  EXPECT_THAT(usage_fault([] { parse_length("5mm", "-x").in_scene_units(0, "-x"); }),
              StartsWith("-x: the input does not say how long a scene unit is"));
}

TEST(Quantity, CountsInSingularAndPlural) {
  EXPECT_EQ(counted(1, "frame"), "1 frame");
  EXPECT_EQ(counted(0, "frame"), "0 frames");
  EXPECT_EQ(counted(2, "vertex", "vertices"), "2 vertices");
}

TEST(Quantity, ReadsPercent) {
  EXPECT_EQ(parse_percent("0.1", "--kg"), 0.1);
  EXPECT_EQ(parse_percent("0.1%", "--kg"), 0.1);
  for (const char* text : {"", "%", "0", "-1%", "1%%", "1 %", "nan"})
    EXPECT_THAT(usage_fault([&] { parse_percent(text, "--kg"); }), StartsWith("--kg: '")) << text;
}

TEST(Quantity, RefusesWhatIsNoLength) {
  for (const char* text :
       {"", "%", "-1", "nan", "inf", "1e999", "1 %", "0.1%%", "0.1mmm", "mm", "1,5"})
    EXPECT_THAT(usage_fault([&] { parse_length(text, "--max-error"); }),
                StartsWith("--max-error: '"))
        << text;
  EXPECT_THAT(usage_fault([] { parse_length("0", "--max-error"); }), HasSubstr("lossless"));
  EXPECT_THAT(usage_fault([] { parse_length("0%", "--max-error"); }), HasSubstr("lossless"));
}

TEST(Quantity, ReadsSizes) {
  EXPECT_EQ(parse_size("40000", "-x"), 40000U);
  EXPECT_EQ(parse_size("40k", "-x"), 40000U);
  EXPECT_EQ(parse_size("1.5M", "-x"), 1500000U);
  EXPECT_EQ(parse_size("2G", "-x"), 2000000000U);
  for (const char* text : {"", "k", "0", "-5", "0.5", "5 k", "5kB", "1e30", "nan"})
    EXPECT_THAT(usage_fault([&] { parse_size(text, "--size"); }), StartsWith("--size: '")) << text;
}

TEST(Quantity, ReadsUnits) {
  EXPECT_EQ(parse_unit("cm", "-x"), 0.01);
  EXPECT_EQ(parse_unit("0.3048", "-x"), 0.3048);
  EXPECT_THAT(usage_fault([] { parse_unit("parsec", "--unit"); }), HasSubstr("parsec"));
  EXPECT_THAT(usage_fault([] { parse_unit("0", "--unit"); }), HasSubstr("--unit"));
}

TEST(Quantity, SortsCounts) {
  EXPECT_THAT(parse_counts("20,5,5,10", "-x"), ElementsAre(5, 10, 20));
  for (const char* text : {"", "0", "5,", ",5", "5;6", "-1", "5, 6"})
    EXPECT_THAT(usage_fault([&] { parse_counts(text, "--counts"); }), HasSubstr("--counts"))
        << text;
}

std::vector<uint32_t> frames(const char* text, uint32_t count) {
  FrameRange range = parse_frames(text, "--frames", count);
  std::vector<uint32_t> list;
  for (uint32_t f = range.first; f < range.end; f += range.step)
    list.push_back(f);
  EXPECT_EQ(list.size(), range.size()) << text;
  return list;
}

TEST(Quantity, ReadsFramesAsPythonDoes) {
  EXPECT_THAT(frames("1:4", 5), ElementsAre(1, 2, 3));
  EXPECT_THAT(frames("3:", 5), ElementsAre(3, 4));
  EXPECT_THAT(frames(":2", 5), ElementsAre(0, 1));
  EXPECT_THAT(frames("::2", 5), ElementsAre(0, 2, 4));
  EXPECT_THAT(frames("1:5:3", 5), ElementsAre(1, 4));
  EXPECT_THAT(frames("4", 5), ElementsAre(4));
  EXPECT_THAT(frames("0:1:4000000000", 5), ElementsAre(0));
}

TEST(Quantity, RefusesFramesThatAreNotThere) {
  for (const char* text : {"", "a", "1:b", "1:2:0", "1:2:3:4", "5", "5:", "2:2", "3:2", "0:6",
                           "-1:", "99999999999", "0:5:"})
    EXPECT_THAT(usage_fault([&] { parse_frames(text, "--frames", 5); }), StartsWith("--frames: '"))
        << text;
}

TEST(Quantity, GroupsDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1 000");
  EXPECT_EQ(grouped(1234567), "1 234 567");
}

TEST(Quantity, RoundsBytes) {
  EXPECT_EQ(readable_bytes(999), "999 bytes");
  EXPECT_EQ(readable_bytes(45123), "45.1 kB");
  EXPECT_EQ(readable_bytes(1250000), "1.25 MB");
  EXPECT_EQ(readable_bytes(3000000000), "3.00 GB");
}

}  // namespace
}  // namespace anicodec::tools
