// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/report/chart.h"

#include "tests/tools/command_testing.h"
#include "tools/report/report.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace anicodec::tools {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Chart, DrawsAPointWhereItsValuesAre) {
  Chart chart;
  chart.series = {{"a<b", {{0, 0}, {10, 100}}, false}, {"c", {{5, 50}}, true}};
  const std::string svg = svg_of(chart);
  EXPECT_THAT(svg, HasSubstr("a&lt;b: 10, 100"));
  EXPECT_THAT(svg, HasSubstr(">60</text>"));
  EXPECT_THAT(svg, HasSubstr("s1 dashed"));
}

TEST(Chart, LeavesOutWhatALogarithmCannotShow) {
  Chart chart;
  chart.log_y = true;
  chart.series = {{"a", {{1, 0}, {2, -1}}, false}};
  EXPECT_THAT(svg_of(chart), HasSubstr("Nothing to draw"));
  chart.series[0].points.emplace_back(3, 0.1);
  EXPECT_THAT(svg_of(chart), HasSubstr("<circle"));
}

TEST(Chart, IsAFileWithItsLegendInside) {
  Chart chart;
  chart.series = {{"a", {{0, 0}, {10, 100}}, false}, {"b&c", {{5, 50}}, true}};
  const std::string svg = svg_file(chart);
  EXPECT_EQ(svg.rfind("<svg xmlns=", 0), 0U);
  EXPECT_THAT(svg, HasSubstr(">b&amp;c</text>"));
}

}  // namespace
}  // namespace anicodec::tools
