// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/html_text.h"
#include "tools/report/chart.h"
#include "tools/report/page_parts.h"
#include "tools/report/report.h"
#include "tools/words/quantity.h"
#include "tools/words/version.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

std::string tile(const std::string& value, const std::string& what) {
  return fmt::format("<div><b>{}</b><span class=\"quiet\">{}</span></div>", value, what);
}

/// Lines by codec, in the order of their names.
template <class Value>
Chart rate_chart(const Report& report, const char* label, Value value) {
  Chart chart;
  chart.x_label = "bits per vertex and frame";
  chart.y_label = label;
  chart.log_x = chart.log_y = true;
  for (const RatePoint& p : report.rates) {
    if (value(p) <= 0)
      continue;  // a lossless one is in the table alone
    if (chart.series.empty() || chart.series.back().name != p.codec)
      chart.series.push_back({p.codec, {}, !is_own(p.codec)});
    chart.series.back().points.emplace_back(p.bpfv, value(p));
  }
  return chart;
}

/// Errors of the methods whose names `wanted` accepts, against the number of elements.
template <class Wanted>
Chart basis_chart(const Report& report, Wanted wanted) {
  Chart chart;
  chart.x_label = "key-frames or components";
  chart.y_label = "KG error in %";
  chart.log_y = true;
  for (const BasisError& e : report.basis_errors) {
    if (!wanted(e.method))
      continue;
    if (chart.series.empty() || chart.series.back().name != e.method)
      chart.series.push_back({e.method, {}, e.method.rfind("pca", 0) == 0});
    chart.series.back().points.emplace_back(static_cast<double>(e.k), e.kg);
  }
  return chart;
}

std::string rate_table(const Report& report) {
  std::string out =
      "<div class=\"scroll\"><table><tr><th>codec</th><th>bytes</th><th>bits per vertex and "
      "frame</th><th>KG error %</th><th>largest error, % of diagonal</th><th>STED</th></tr>";
  for (const RatePoint& p : report.rates)
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.3f}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.3g}</td></"
        "tr>",
        html_text(p.codec), grouped(p.bytes), p.bpfv, p.kg, p.max_error_percent, p.sted);
  return out + "</table></div>";
}

std::string share_bar(const Report& report) {
  std::string bar, legend;
  for (size_t i = 0; i < report.shares.size(); ++i) {
    const ByteShare& share = report.shares[i];
    const double percent =
        100 * static_cast<double>(share.bytes) / static_cast<double>(report.shown_bytes);
    bar += fmt::format("<span class=\"s{}\" style=\"width:{:.2f}%\" title=\"{}\"></span>", i % 8,
                       percent, html_text(share.what));
    legend += fmt::format("<span class=\"s{}\"><i></i>{}: {} bytes, {:.1f} %</span> ", i % 8,
                          html_text(share.what), grouped(share.bytes), percent);
  }
  return "<div class=\"bar\">" + bar + "</div><div class=\"legend\">" + legend + "</div>";
}

Chart frame_chart(const Report& report) {
  Chart chart;
  chart.x_label = "frame";
  chart.y_label = "error, % of the diagonal";
  chart.dots = false;
  chart.series = {{"largest", {}, false}, {"root mean square", {}, false}};
  for (size_t f = 0; f < report.shown.frames.size(); ++f) {
    const FrameError& e = report.shown.frames[f];
    chart.series[0].points.emplace_back(static_cast<double>(f), report.shown.percent(e.max));
    chart.series[1].points.emplace_back(static_cast<double>(f), report.shown.percent(e.rmse));
  }
  return chart;
}

/// A line for each shape space against what `x` says.
template <class Value>
Chart space_chart(const Report& report, const char* label, bool log_x, Value x) {
  Chart chart;
  chart.x_label = label;
  chart.y_label = "KG error in %";
  chart.log_x = log_x;
  chart.log_y = true;
  for (const ShapeSpaceError& e : report.shape_spaces) {
    if (chart.series.empty() || chart.series.back().name != e.space)
      chart.series.push_back({e.space, {}, false});
    chart.series.back().points.emplace_back(x(e), e.kg);
  }
  return chart;
}

std::string space_table(const Report& report) {
  std::string out =
      "<div class=\"scroll\"><table><tr><th>space</th><th>components</th><th>KG error %</th>"
      "<th>numbers in a component</th><th>float32 bytes</th><th>variance left in the space, %</th>"
      "</tr>";
  for (const ShapeSpaceError& e : report.shape_spaces)
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.3g}</td><td>{}</td><td>{}</td><td>{:.3g}</td></tr>",
        html_text(e.space), e.k, e.kg, grouped(e.numbers), grouped(e.bytes), e.residual_percent);
  return out + "</table></div>";
}

bool starts_with(const std::string& text, const char* prefix) {
  return text.rfind(prefix, 0) == 0;
}

std::string keyframe_section(const Report& report) {
  std::string out =
      "<h2>Key-frames and components</h2><p>The clip expressed by so many exact key-frames, chosen "
      "by Neural Gas (gas), pivoting (pivot) or evenly (uniform), or by principal components "
      "(pca, dashed). Nothing is quantised.</p><div class=\"charts\">";

  struct Kind {
    const char* weights;
    const char* title;
  };

  constexpr Kind kKinds[] = {
      {"linear", "Any weights"},
      {"sum-to-one", "Weights that sum to one, so that a clip far from the origin costs nothing"},
      {"rigid", "A rigid motion for each frame, then weights of what it leaves"}};
  for (const Kind& kind : kKinds) {
    const std::string weights = kind.weights;
    const bool rigid = weights == "rigid";
    Chart chart = basis_chart(report, [&](const std::string& method) {
      return method.find("-" + weights) != std::string::npos ||
             (!rigid && starts_with(method, "pca") && method != "pca-mean-rigid");
    });
    chart.title = kind.title;
    out += svg_of(chart);
  }
  out += "</div>";
  if (!report.keyframes.empty()) {
    out += "<p>Key-frames that pivoting takes first.</p><div class=\"sheet\">";
    for (const ReportPicture& p : report.keyframes)
      out += figure_of(p.caption, p.image);
    out += "</div>";
  }
  return out;
}

Chart kg_chart(const Report& report) {
  return rate_chart(report, "KG error in %", [](const RatePoint& p) { return p.kg; });
}

}  // namespace

std::string rate_figure(const Report& report) {
  return svg_file(kg_chart(report));
}

std::string report_page(const Report& report) {
  const std::string below = fmt::format(
      "{} vertices, {} faces, {} frames at {:.4g} per second{}. Made by anicodec {}.",
      grouped(report.vertices), grouped(report.faces), report.frames, report.rate.value(),
      report.rate.assumed ? ", which is assumed: the source names no rate" : "", version());
  std::string out;
  const double raw = 12.0 * report.vertices * report.frames;
  if (report.shown_bytes > 0) {
    const auto bytes = static_cast<double>(report.shown_bytes);
    out += "<div class=\"tiles\">" +
           tile(readable_bytes(report.shown_bytes),
                fmt::format("at a KG error of {:g} %", report.shown_kg)) +
           tile(fmt::format("{:.0f} : 1", raw / bytes), "against float32 positions") +
           tile(fmt::format("{:.3f}", 8 * bytes / report.vertices / report.frames),
                "bits per vertex and frame") +
           tile(fmt::format("{:.3g} %", report.shown.percent(report.shown.max_error)),
                "largest error, of the diagonal") +
           "</div>";
  }
  if (!report.player.empty())
    out += "<iframe loading=\"lazy\" title=\"The clip, playing\" srcdoc=\"" +
           escaped_markup(report.player) + "\"></iframe>";
  out +=
      "<h2>Size against error</h2><p>Whole files, of positions and faces. Lower and further left "
      "is better. Other codecs "
      "are dashed: they store the positions of a cubic grid whose step gives the error.</p>"
      "<div class=\"charts\">";
  out += svg_of(kg_chart(report));
  out += svg_of(rate_chart(report, "largest error, % of the diagonal",
                           [](const RatePoint& p) { return p.max_error_percent; }));
  out += svg_of(rate_chart(report, "STED", [](const RatePoint& p) { return p.sted; }));
  out += "</div>" + rate_table(report);
  if (report.shown_bytes > 0) {
    out += fmt::format(
        "<h2>Where the bytes went</h2><p>The file of {} bytes at a KG error of {:g} %."
        "</p>",
        grouped(report.shown_bytes), report.shown_kg);
    out += share_bar(report);
    out += "<h2>Where the error is</h2><div class=\"charts\">" + svg_of(frame_chart(report)) +
           "</div>";
    if (!report.pictures.empty()) {
      out +=
          "<p>Original, decoded, and the decoded frame coloured by error: grey is none, black the "
          "largest of the clip.</p><div class=\"pictures\">";
      for (const ReportPicture& p : report.pictures)
        out += figure_of(p.caption, p.image);
      out += "</div>";
    }
  }
  if (report.basis_errors.empty()) {
    out +=
        "<p>Other codecs, key-frames and shape spaces: <code>anicodec analyze --full</code>.</p>";
  } else {
    out += keyframe_section(report);
  }
  if (!report.shape_spaces.empty()) {
    out +=
        "<h2>Shape spaces</h2><p>Principal components of vertex positions (vertices), of edge "
        "lengths and dihedral angles, rebuilt by multi-scale geometry interpolation (edges), and "
        "of deformation gradients (gradients); frames are compared after the best rigid motion. "
        "A component of edges takes about twice the numbers of one of vertices, one of gradients "
        "six times: at the right, the mean, the components and their weights in float32.</p>"
        "<div class=\"charts\">";
    out += svg_of(space_chart(report, "components", false,
                              [](const ShapeSpaceError& e) { return static_cast<double>(e.k); }));
    out += svg_of(space_chart(report, "bytes", true, [](const ShapeSpaceError& e) {
      return static_cast<double>(e.bytes);
    }));
    out += "</div>" + space_table(report);
  }
  if (report.massage)
    out += massage_section(*report.massage);
  return page_around(report.name.empty() ? "clip" : report.name, below, out);
}

}  // namespace anicodec::tools
