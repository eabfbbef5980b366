// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/report/chart.h"

#include "tools/render/html_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr double kLegendLine = 20;
constexpr double kWidth = 460, kHeight = 300, kLeft = 62, kRight = 14, kTop = 12, kBottom = 44;

/// One direction of a chart: from values to positions, with ticks at round values.
class Axis {
 public:
  Axis(double low, double high, bool logarithmic) : logarithmic_(logarithmic) {
    low_ = map(low);
    high_ = map(high);
    const double margin = high_ > low_ ? 0.04 * (high_ - low_) : 0.5;
    low_ -= margin;
    high_ += margin;
    if (!logarithmic_ && low >= 0)
      low_ = std::max(low_, 0.0);
  }

  double share(double value) const { return (map(value) - low_) / (high_ - low_); }

  std::vector<double> ticks() const {
    std::vector<double> out;
    if (logarithmic_) {
      // 1, 2, 5 where there are few decades, else powers of ten.
      const bool few = high_ - low_ < 2.5;
      for (double decade = std::floor(low_); decade <= high_; ++decade) {
        for (double digit : {1.0, 2.0, 5.0}) {
          const double value = digit * std::pow(10, decade);
          if ((few || digit == 1) && map(value) >= low_ && map(value) <= high_)
            out.push_back(value);
        }
      }
      return out;
    }
    const double rough = (high_ - low_) / 6, decade = std::pow(10, std::floor(std::log10(rough)));
    double step = 10 * decade;
    for (double digit : {5.0, 2.0, 1.0}) {
      if (digit * decade >= rough)
        step = digit * decade;
    }
    for (double value = std::ceil(low_ / step) * step; value <= high_; value += step)
      out.push_back(std::abs(value) < 1e-9 * step ? 0 : value);
    return out;
  }

 private:
  double map(double value) const { return logarithmic_ ? std::log10(value) : value; }

  bool logarithmic_;
  double low_, high_;
};

std::string label_of(double value) {
  const double size = std::abs(value);
  if (size >= 1e6)
    return fmt::format("{:g}M", value / 1e6);
  if (size >= 1e4)
    return fmt::format("{:g}k", value / 1e3);
  return fmt::format("{:.4g}", value);
}

std::string classes(const Series& series, size_t number) {
  return fmt::format("s{}{}", number % 8, series.dashed ? " dashed" : "");
}

}  // namespace

const char* const kChartStyle = R"(
:root{color-scheme:light dark;--page:#fff;--quiet:#5a6675;--rule:#e1e5ea;
--c0:#1f6feb;--c1:#d1660a;--c2:#1a7f4b;--c3:#b02a5b;--c4:#6f42c1;--c5:#00788a;--c6:#8a6d00;--c7:#6b7280}
@media(prefers-color-scheme:dark){:root{--page:#12161c;--quiet:#9aa6b5;--rule:#2b333d;
--c0:#6ea8ff;--c1:#ffa657;--c2:#56d39b;--c3:#ff7eb0;--c4:#b99aff;--c5:#4fd1e5;--c6:#e3c34c;--c7:#aab4c0}}
svg text{fill:var(--quiet);font:12px system-ui,sans-serif}.grid{stroke:var(--rule);fill:none}.page{fill:var(--page)}
.line{fill:none;stroke:currentColor;stroke-width:2}circle{fill:currentColor}
.dashed .line{stroke-dasharray:5 4}
.s0{color:var(--c0)}.s1{color:var(--c1)}.s2{color:var(--c2)}.s3{color:var(--c3)}
.s4{color:var(--c4)}.s5{color:var(--c5)}.s6{color:var(--c6)}.s7{color:var(--c7)}
)";

namespace {

/// The content of the SVG element without the legend; empty if there is nothing to draw.
std::string plot(const Chart& chart) {
  double low[2], high[2];
  std::fill_n(low, 2, std::numeric_limits<double>::infinity());
  std::fill_n(high, 2, -std::numeric_limits<double>::infinity());
  auto shown = [&](const std::pair<double, double>& p) {
    return std::isfinite(p.first) && std::isfinite(p.second) && (!chart.log_x || p.first > 0) &&
           (!chart.log_y || p.second > 0);
  };
  for (const Series& series : chart.series) {
    for (const auto& p : series.points) {
      if (!shown(p))
        continue;
      const double value[2] = {p.first, p.second};
      for (int i = 0; i < 2; ++i) {
        low[i] = std::min(low[i], value[i]);
        high[i] = std::max(high[i], value[i]);
      }
    }
  }
  if (!(low[0] <= high[0]))
    return {};
  const Axis x(low[0], high[0], chart.log_x), y(low[1], high[1], chart.log_y);
  auto px = [&](double v) { return kLeft + x.share(v) * (kWidth - kLeft - kRight); };
  auto py = [&](double v) { return kHeight - kBottom - y.share(v) * (kHeight - kTop - kBottom); };

  std::string out;
  for (double tick : x.ticks())
    out += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
        "text-anchor=\"middle\">{4}</text>",
        px(tick), kTop, kHeight - kBottom, kHeight - kBottom + 16, label_of(tick));
  for (double tick : y.ticks())
    out += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5}</text>",
        kLeft, py(tick), kWidth - kRight, kLeft - 6, py(tick) + 4, label_of(tick));
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
                     (kLeft + kWidth - kRight) / 2, kHeight - 8, html_text(chart.x_label));
  out += fmt::format(
      "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
      (kTop + kHeight - kBottom) / 2, html_text(chart.y_label));
  for (size_t s = 0; s < chart.series.size(); ++s) {
    const Series& series = chart.series[s];
    std::string path, dots;
    for (const auto& p : series.points) {
      if (!shown(p))
        continue;
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px(p.first), py(p.second));
      if (chart.dots)
        dots += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"><title>{}: {:.6g}, "
            "{:.4g}</title></circle>",
            px(p.first), py(p.second), html_text(series.name), p.first, p.second);
    }
    out += fmt::format("<g class=\"{}\"><path class=\"line\" d=\"{}\"/>{}</g>", classes(series, s),
                       path, dots);
  }
  return out;
}

}  // namespace

std::string svg_of(const Chart& chart) {
  const std::string inside = plot(chart);
  if (inside.empty())
    return "<p>Nothing to draw.</p>";
  std::string out = "<figure>";
  if (!chart.title.empty())
    out += "<p>" + html_text(chart.title) + "</p>";
  out += fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\">{}</svg>", kWidth, kHeight, inside);
  if (chart.series.size() > 1) {
    out += "<figcaption class=\"legend\">";
    for (size_t s = 0; s < chart.series.size(); ++s)
      out += fmt::format("<span class=\"{}\"><i></i>{}</span> ", classes(chart.series[s], s),
                         html_text(chart.series[s].name));
    out += "</figcaption>";
  }
  return out + "</figure>";
}

std::string svg_file(const Chart& chart) {
  const double height = kHeight + kLegendLine * static_cast<double>(chart.series.size());
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\"><style>{2}</style><rect class=\"page\" width=\"{0}\" "
      "height=\"{1}\"/>{3}",
      kWidth, height, kChartStyle, plot(chart));
  for (size_t s = 0; s < chart.series.size(); ++s) {
    const double y = kHeight + kLegendLine * (static_cast<double>(s) + 0.3);
    out += fmt::format(
        "<g class=\"{0}\"><path class=\"line\" d=\"M{1} {2}h24\"/></g><text x=\"{3}\" "
        "y=\"{4}\">{5}</text>",
        classes(chart.series[s], s), kLeft, y, kLeft + 32, y + 4, html_text(chart.series[s].name));
  }
  return out + "</svg>\n";
}

}  // namespace anicodec::tools
