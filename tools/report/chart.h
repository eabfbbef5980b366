// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_REPORT_CHART_H_
#define ANICODEC_TOOLS_REPORT_CHART_H_

#include <string>
#include <utility>
#include <vector>

namespace anicodec::tools {

/// A line of a chart. Points are drawn in the order given.
struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;
  bool dashed = false;
};

struct Chart {
  std::string title;  ///< above it, if any
  std::string x_label, y_label;
  bool log_x = false, log_y = false;  ///< values that are not above 0 are then left out
  bool dots = true;
  std::vector<Series> series;
};

/// The chart as an SVG element with its legend below. Colours are the classes s0, s1, ... of the
/// page, so that they follow its theme; every point has a title with its values.
std::string svg_of(const Chart& chart);

/// The chart as a file of its own, with its legend inside.
std::string svg_file(const Chart& chart);

/// Colours and lines of charts, in a light and in a dark surrounding: CSS.
extern const char* const kChartStyle;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_REPORT_CHART_H_
