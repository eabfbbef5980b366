// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/report/interpolation_study.h"

#include "codec/surface/closest_point.h"
#include "codec/surface/edge_network.h"
#include "tools/render/shaded_view.h"
#include "tools/report/chart.h"
#include "tools/report/page_parts.h"
#include "tools/words/version.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr uint32_t kStudyPictureSize = 240;
constexpr uint32_t kMostShown = 5;

double degrees(double radians) {
  return 180 / std::numbers::pi * radians;
}

/// Frames evenly from the first to the last.
std::vector<uint32_t> shown_frames(size_t frames) {
  const auto count = static_cast<uint32_t>(std::min<size_t>(frames, kMostShown));
  std::vector<uint32_t> shown;
  for (uint32_t i = 0; i < count; ++i)
    shown.push_back(
        count == 1 ? 0 : static_cast<uint32_t>((i * (frames - 1) + (count - 1) / 2) / (count - 1)));
  return shown;
}

/// Draws poses, and what is between them, as far away as these reach.
class Studio {
 public:
  explicit Studio(const MeshSequence& poses)
      : view_(poses, box_of(poses), kStudyPictureSize, kStudyPictureSize) {
    camera_.z_up = poses.up == UpAxis::kZ;
  }

  Image draw(std::span<const float> positions) { return view_.draw(positions, camera_); }

 private:
  static Box box_of(const MeshSequence& poses) {
    Box box;
    box.add(poses.positions);
    return box;
  }

  ShadedView view_;
  Camera camera_;
};

/// The frames that the methods should find.
struct Target {
  EdgeShape shape;
  double volume = 0;
};

std::vector<Target> targets_of(const EdgeNetwork& network, const MeshSequence& poses,
                               const std::vector<std::vector<double>>& weights) {
  std::vector<Points> points;
  for (uint32_t i = 0; i < poses.frame_count; ++i)
    points.push_back(to_points(poses.frame(i)));
  const std::vector<EdgeShape> shapes = measure_edges(network, points);
  std::vector<Target> targets;
  for (const std::vector<double>& row : weights) {
    Target& target = targets.emplace_back(Target{blend_edges(shapes, row)});
    for (size_t i = 0; i < points.size(); ++i)
      target.volume += row[i] * enclosed_volume(network, points[i]);
  }
  return targets;
}

/// A chart of an error against the frame, a line for each method.
template <class Value>
std::string chart_of(const InterpolationStudy& study, const char* label, Value value) {
  Chart chart;
  chart.x_label = "frame";
  chart.y_label = label;
  chart.log_y = true;
  chart.dots = false;
  for (const MethodStudy& m : study.methods) {
    Series& series = chart.series.emplace_back();
    series.name = name_of(m.method);
    series.dashed = m.method == InterpolationMethod::kLinear;
    for (size_t f = 0; f < m.frames.size(); ++f)
      series.points.emplace_back(static_cast<double>(f), value(m.frames[f]));
  }
  return svg_of(chart);
}

std::string weights_text(const std::vector<double>& weights) {
  std::string text;
  for (const double w : weights)
    text += fmt::format("{}{:.3g}", text.empty() ? "" : " : ", w);
  return text;
}

std::string table_of(const InterpolationStudy& study) {
  std::string out =
      "<div class=\"scroll\"><table><tr><th>method</th><th>length %</th><th>largest %</th>"
      "<th>angle in degrees</th><th>volume %</th><th>folded</th><th>collapsed</th></tr>";
  for (const MethodStudy& m : study.methods) {
    const EdgeError e = m.summary();
    out += fmt::format(
        "<tr><td>{}</td><td>{:.4g}</td><td>{:.4g}</td><td>{:.4g}</td><td>{:.4g}</td><td>{}</td>"
        "<td>{}</td></tr>",
        name_of(m.method), 100 * e.length, 100 * e.largest_length, degrees(e.angle), 100 * e.volume,
        e.folded, e.collapsed);
  }
  return out + "</table></div>";
}

}  // namespace

EdgeError MethodStudy::summary() const {
  EdgeError sum;
  for (const EdgeError& e : frames) {
    sum.length += e.length;
    sum.angle += e.angle;
    sum.volume += e.volume;
    sum.largest_length = std::max(sum.largest_length, e.largest_length);
    sum.folded += e.folded;
    sum.collapsed += e.collapsed;
  }
  const double count = std::max<double>(1, static_cast<double>(frames.size()));
  sum.length /= count;
  sum.angle /= count;
  sum.volume /= count;
  return sum;
}

InterpolationStudy study_interpolation(const MeshSequence& poses,
                                       const std::vector<std::vector<double>>& weights,
                                       InterpolationOptions options, bool pictures,
                                       const Progress& progress) {
  const std::vector<uint32_t> triangles = fan_triangles(poses.polygons);
  const EdgeNetwork network(triangles, poses.vertex_count);
  const std::vector<Target> targets = targets_of(network, poses, weights);
  std::vector<std::span<const float>> inputs;
  for (uint32_t i = 0; i < poses.frame_count; ++i)
    inputs.push_back(poses.frame(i));
  InterpolationStudy study;
  study.weights = weights;
  std::optional<Studio> studio;
  if (pictures) {
    studio.emplace(poses);
    study.shown = shown_frames(weights.size());
    for (const std::span<const float> x : inputs)
      study.inputs.push_back(studio->draw(x));
  }
  for (const InterpolationMethod method : interpolation_methods()) {
    if (progress)
      progress(fmt::format("method {}", name_of(method)).c_str(),
               static_cast<double>(study.methods.size()) /
                   static_cast<double>(interpolation_methods().size()));
    options.method = method;
    const auto interpolation = make_interpolation(triangles, poses.vertex_count, inputs, options);
    MethodStudy& m = study.methods.emplace_back();
    m.method = method;
    for (uint32_t f = 0; f < weights.size(); ++f) {
      const std::span<const float> x = interpolation->evaluate(weights[f]);
      m.frames.push_back(edge_error(network, to_points(x), targets[f].shape, targets[f].volume));
      if (std::ranges::binary_search(study.shown, f))
        m.pictures.push_back(studio->draw(x));
    }
  }
  return study;
}

std::string interpolation_text(const InterpolationStudy& study) {
  std::string out =
      fmt::format("{:<10} {:>10} {:>10} {:>10} {:>10} {:>7} {:>9}\n", "method", "length %",
                  "largest %", "angle deg", "volume %", "folded", "collapsed");
  for (const MethodStudy& m : study.methods) {
    const EdgeError e = m.summary();
    out += fmt::format("{:<10} {:>10.4f} {:>10.2f} {:>10.4f} {:>10.4f} {:>7} {:>9}\n",
                       name_of(m.method), 100 * e.length, 100 * e.largest_length, degrees(e.angle),
                       100 * e.volume, e.folded, e.collapsed);
  }
  return out;
}

nlohmann::ordered_json interpolation_json(const InterpolationStudy& study) {
  nlohmann::ordered_json methods = nlohmann::ordered_json::array();
  for (const MethodStudy& m : study.methods) {
    const EdgeError e = m.summary();
    methods.push_back({{"method", name_of(m.method)},
                       {"length_percent", 100 * e.length},
                       {"largest_length_percent", 100 * e.largest_length},
                       {"angle_degrees", degrees(e.angle)},
                       {"volume_percent", 100 * e.volume},
                       {"folded", e.folded},
                       {"collapsed", e.collapsed}});
  }
  return {{"methods", methods}};
}

std::string interpolation_page(const InterpolationStudy& study, const std::string& name) {
  std::string out = "<h2>The meshes</h2><div class=\"sheet\">";
  for (size_t i = 0; i < study.inputs.size(); ++i)
    out += figure_of(fmt::format("mesh {}", i), study.inputs[i]);
  out +=
      "</div><h2>Errors</h2><p>How far edges, angles between triangles and the volume are from "
      "those "
      "that the weights ask for: means over the frames, of edges the largest, too; angles that are "
      "off "
      "by more than a right angle, and triangles that have lost nine tenths of their area, counted "
      "over all "
      "frames.</p>" +
      table_of(study) + "<div class=\"charts\">" +
      chart_of(study, "edge lengths, mean error in %",
               [](const EdgeError& e) { return 100 * e.length; }) +
      chart_of(study, "angles, mean error in degrees",
               [](const EdgeError& e) { return degrees(e.angle); }) +
      chart_of(study, "volume, error in %", [](const EdgeError& e) { return 100 * e.volume; }) +
      "</div>";
  for (const MethodStudy& m : study.methods) {
    out += fmt::format("<h2>{}</h2><div class=\"sheet\">", name_of(m.method));
    for (size_t i = 0; i < m.pictures.size(); ++i)
      out += figure_of(weights_text(study.weights[study.shown[i]]), m.pictures[i]);
    out += "</div>";
  }
  return page_around(
      name,
      fmt::format("{} frames between {} meshes by {} methods. Made by anicodec {}.",
                  study.weights.size(), study.inputs.size(), study.methods.size(), version()),
      out);
}

}  // namespace anicodec::tools
