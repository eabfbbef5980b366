// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/report/massage_study.h"

#include "codec/algebra/gram.h"
#include "codec/encode.h"
#include "codec/massage/massage.h"
#include "codec/studies/basis_error.h"
#include "tools/report/chart.h"
#include "tools/words/quantity.h"

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr double kTargets[] = {0.3, 0.1};

/// KG errors of 0, 1, ... components.
std::vector<double> component_errors(const MeshSequence& sequence) {
  const FrameGram gram = frame_gram(FrameView(sequence));
  std::vector<double> errors = principal_errors(gram.clip_centred());
  for (double& e : errors)
    e = kg_error(e, gram.kg_reference());
  return errors;
}

uint64_t size_at(const MeshSequence& sequence, double kg, Effort effort, const Progress& progress) {
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, kg, false};
  options.effort = effort;
  options.order = OrderMode::kFree;
  return encode(sequence, options, progress).file.size();
}

}  // namespace

MassageStudy study_massage(const MeshSequence& sequence, std::span<const size_t> counts,
                           Effort effort, const Progress& progress) {
  MassageStudy study;
  const MeshSequence massaged = massage(sequence, {}, progress).sequence;
  const std::vector<double> original_errors = component_errors(sequence);
  const std::vector<double> massaged_errors = component_errors(massaged);
  for (size_t k : counts) {
    if (k < original_errors.size())
      study.components.push_back({k, original_errors[k], massaged_errors[k]});
  }
  for (double kg : kTargets)
    study.sizes.push_back(
        {kg, size_at(sequence, kg, effort, progress), size_at(massaged, kg, effort, progress)});
  study.moved = compare_surfaces(sequence, massaged);
  study.before = massage_quality(sequence, sequence, 0);
  study.after = massage_quality(sequence, massaged, 0);
  return study;
}

nlohmann::ordered_json massage_json(const MassageStudy& study) {
  auto quality = [](const MassageQuality& q) -> nlohmann::ordered_json {
    return {{"conformal_mean", q.distortion.conformal_mean},
            {"area_mean", q.distortion.area_mean},
            {"radius_ratio", q.radius_ratio},
            {"turned", q.turned}};
  };
  nlohmann::ordered_json json;
  json["components"] = nlohmann::ordered_json::array();
  for (const ComponentErrors& e : study.components)
    json["components"].push_back({{"k", e.k}, {"original", e.original}, {"massaged", e.massaged}});
  json["sizes"] = nlohmann::ordered_json::array();
  for (const MassagedSize& s : study.sizes)
    json["sizes"].push_back({{"kg", s.kg}, {"original", s.original}, {"massaged", s.massaged}});
  const HausdorffDistance& total = study.moved.total;
  json["hausdorff_mean_percent"] = study.moved.percent(total.mean());
  json["hausdorff_rms_percent"] = study.moved.percent(total.rms());
  json["hausdorff_percent"] = study.moved.percent(total.max());
  json["before"] = quality(study.before);
  json["after"] = quality(study.after);
  return json;
}

std::string massage_csv(const MassageStudy& study) {
  std::string out = "series,x,original,massaged\n";
  for (const ComponentErrors& e : study.components)
    out += fmt::format("pca,{},{:.6g},{:.6g}\n", e.k, e.original, e.massaged);
  for (const MassagedSize& s : study.sizes)
    out += fmt::format("bytes,{:g},{},{}\n", s.kg, s.original, s.massaged);
  return out;
}

std::string massage_text(const MassageStudy& study) {
  std::string out = fmt::format("{:<28} {:>12} {:>12}\n", "", "original", "massaged");
  auto row = [&out](const std::string& name, const std::string& original,
                    const std::string& massaged) {
    out += fmt::format("{:<28} {:>12} {:>12}\n", name, original, massaged);
  };
  for (const ComponentErrors& e : study.components)
    row(fmt::format("KG % in {} components", e.k), fmt::format("{:.4g}", e.original),
        fmt::format("{:.4g}", e.massaged));
  for (const MassagedSize& s : study.sizes)
    row(fmt::format("bytes at KG {:g} %", s.kg), grouped(s.original), grouped(s.massaged));
  auto number = [](double x) { return fmt::format("{:.4f}", x); };
  row("radius ratio", number(study.before.radius_ratio), number(study.after.radius_ratio));
  row("conformal distortion", number(study.before.distortion.conformal_mean),
      number(study.after.distortion.conformal_mean));
  row("area distortion", number(study.before.distortion.area_mean),
      number(study.after.distortion.area_mean));
  const HausdorffDistance& total = study.moved.total;
  return out + fmt::format(
                   "the surface moved by {:.3g} % of the diagonal on average, {:.3g} % RMS, {:.3g} "
                   "% at most\n",
                   study.moved.percent(total.mean()), study.moved.percent(total.rms()),
                   study.moved.percent(total.max()));
}

std::string massage_section(const MassageStudy& study) {
  Chart chart;
  chart.x_label = "components";
  chart.y_label = "KG error in %";
  chart.log_y = true;
  chart.series = {{"original", {}, true}, {"massaged", {}, false}};
  for (const ComponentErrors& e : study.components) {
    chart.series[0].points.emplace_back(static_cast<double>(e.k), e.original);
    chart.series[1].points.emplace_back(static_cast<double>(e.k), e.massaged);
  }
  std::string table =
      "<div class=\"scroll\"><table><tr><th>KG error %</th><th>bytes</th><th>bytes, massaged</th>"
      "<th>change %</th></tr>";
  for (const MassagedSize& s : study.sizes)
    table +=
        fmt::format("<tr><td>{:g}</td><td>{}</td><td>{}</td><td>{:+.1f}</td></tr>", s.kg,
                    grouped(s.original), grouped(s.massaged),
                    100 * (static_cast<double>(s.massaged) / static_cast<double>(s.original) - 1));
  const HausdorffDistance& total = study.moved.total;
  return fmt::format(
             "<h2>Mesh Massage</h2><p>Error of the clip in so many exact principal components, as "
             "it is and massaged, each against itself; below, what the files take. A smaller error "
             "in components need not mean a smaller file. The surface moved by {:.3g} % of the "
             "diagonal on average, {:.3g} % at most; the mean conformal distortion towards frame 0 "
             "went from {:.4f} to {:.4f}.</p><div class=\"charts\">",
             study.moved.percent(total.mean()), study.moved.percent(total.max()),
             study.before.distortion.conformal_mean, study.after.distortion.conformal_mean) +
         svg_of(chart) + "</div>" + table + "</table></div>";
}

}  // namespace anicodec::tools
