// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/encoding/encode_report.h"

#include "format/container.h"
#include "tools/program/print.h"
#include "tools/words/names.h"
#include "tools/words/quantity.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

/// The rates that a file of this size means for a clip.
struct Rate {
  explicit Rate(const EncodeResult& result) {
    const auto positions = static_cast<double>(result.positions);
    auto bytes = static_cast<double>(result.file.size());
    ratio = 12 * positions / bytes;
    bpfv = 8 * bytes / positions;
  }

  double ratio = 0;  ///< float32 positions against it
  double bpfv = 0;   ///< bits per frame and vertex
};

/// The feature bits of a file.
uint64_t features_of(ByteView file) {
  ContainerReader reader;
  reader.open(file);
  return reader.features();
}

double percent(double length, double diagonal) {
  return length == 0 ? 0 : 100 * length / diagonal;
}

/// The largest error of all clips, each in per cent of its own diagonal.
double max_error_percent(const EncodeResult& result) {
  if (result.clips.size() < 2)
    return percent(result.max_error, result.diagonal);
  double most = 0;
  for (const ClipResult& clip : result.clips)
    most = std::max(most, percent(clip.max_error, clip.diagonal));
  return most;
}

}  // namespace

const char* EncodeReport::origin_of(const FrameRate& rate) const {
  return rate_asked ? "asked" : rate.assumed ? "assumed" : "source";
}

nlohmann::ordered_json EncodeReport::json() const {
  Rate rate(result);
  nlohmann::ordered_json json;
  json["file"] = path;
  json["bytes"] = result.file.size();
  if (glb_bytes > 0)
    json["glb_bytes"] = glb_bytes;
  json["ratio"] = rate.ratio;
  json["bpfv"] = rate.bpfv;
  json["meshes"] = result.meshes;
  json["vertices"] = result.vertices;
  json["faces"] = result.faces;
  json["frames"] = result.frames;
  json["fps"] = result.rate.value();
  json["fps_from"] = origin_of(result.rate);
  json["basis"] = name_of(result.kind);
  json["features"] = feature_list(features_of(result.file));
  json["components"] = result.components;
  json["kg"] = result.kg;
  json["rmse"] = result.rmse;
  json["max_displacement_error"] = result.max_displacement_error;
  json["max_error"] = result.max_error;
  json["max_error_percent"] = max_error_percent(result);
  json["diagonal"] = result.diagonal;
  json["massaged"] = result.massage.change.has_value();
  json["surface_error"] = result.massage.change ? result.massage.change->max : 0;
  json["surface_error_mean"] = result.massage.change ? result.massage.change->mean : 0;
  json["clips"] = nlohmann::ordered_json::array();
  for (const ClipResult& clip : result.clips)
    json["clips"].push_back({{"name", clip.name},
                             {"frames", clip.frames},
                             {"fps", clip.rate.value()},
                             {"fps_from", origin_of(clip.rate)},
                             {"kg", clip.kg},
                             {"rmse", clip.rmse},
                             {"max_displacement_error", clip.max_displacement_error},
                             {"max_error", clip.max_error},
                             {"max_error_percent", percent(clip.max_error, clip.diagonal)},
                             {"diagonal", clip.diagonal}});
  json["moving_attributes"] = nlohmann::ordered_json::array();
  for (const AttributeResult& a : result.attributes)
    json["moving_attributes"].push_back({{"kind", name_of(a.kind)},
                                         {"name", a.name},
                                         {"bytes", a.bytes},
                                         {"asked", a.asked},
                                         {"max_error", a.max_error},
                                         {"rmse", a.rmse}});
  json["notes"] = notes;
  return json;
}

/// Prints the errors that the clips reached, and which of them share a basis.
void EncodeReport::print_clips(int verbosity) const {
  uint32_t first = 0;
  for (const ClipResult& clip : result.clips) {
    print_line("  clip \"{}\": {} at {:.6g} fps ({}), max error {:.4g} ({:.3g} %), KG {:.3g} %",
               clip.name, counted(clip.frames, "frame"), clip.rate.value(), origin_of(clip.rate),
               clip.max_error, percent(clip.max_error, clip.diagonal), clip.kg);
    for (const FrameRun& segment : result.segments) {
      if (verbosity == 0 || segment.first + segment.count <= first ||
          segment.first >= first + clip.frames)
        continue;
      const bool shared =
          segment.first < first || segment.first + segment.count > first + clip.frames;
      print_line("    frames {}:{} by a basis {}", segment.first, segment.first + segment.count,
                 shared ? "shared among clips" : "of its own, on the shared pose");
    }
    first += clip.frames;
  }
}

void EncodeReport::print_text(int verbosity) const {
  if (verbosity > 0) {
    size_t width = 0;
    for (const Trial& trial : result.trials)
      width = std::max(width, trial.what.size());
    for (const Trial& trial : result.trials)
      fmt::print("  tried {:<{}} {:>12} bytes  RMSE {:<11.4g} max error {:.4g}\n", trial.what,
                 width, grouped(trial.bytes), trial.rmse, trial.max_error);
    for (const std::string& note : result.search_notes)
      print_line("  {}", note);
  }
  if (massage_was_choice && verbosity > 0)
    fmt::print("  massage: sample {} bytes plain, {} massaged; whole clip plain {}\n",
               grouped(result.massage.sample_plain_bytes),
               grouped(result.massage.sample_massaged_bytes), grouped(result.massage.plain_bytes));
  if (result.massage.change)
    fmt::print(
        "massaged: the surface moved by {:.3g} % of the diagonal on average, {:.3g} % at most\n",
        percent(result.massage.change->mean, result.diagonal),
        percent(result.massage.change->max, result.diagonal));
  else if (massage_was_choice)
    fmt::print("not massaged: the clip would not become smaller\n");
  Rate rate(result);
  std::string frames = counted(result.frames, "frame");
  if (result.clips.size() > 1)
    frames += fmt::format(" of {} clips", result.clips.size());
  else if (result.frames > 1)
    frames += fmt::format(" at {:.6g} fps ({})", result.rate.value(), origin_of(result.rate));
  // Meshes have bases of their own.
  const std::string shape = result.meshes > 1 ? counted(result.meshes, "mesh", "meshes")
                                              : counted_components(result.components, result.kind);
  print_line(
      "{}: {} bytes, {:.1f} : 1, {:.3f} bpfv; {}; {}; max error {:.4g} ({:.3g} %), KG {:.3g} %",
      path, grouped(result.file.size()), rate.ratio, rate.bpfv, frames, shape, result.max_error,
      max_error_percent(result), result.kg);
  if (const uint64_t features = features_of(result.file); features != 0)
    print_line("  needs the feature {}, which decoders may lack", feature_names(features));
  if (result.clips.size() > 1)
    print_clips(verbosity);
  for (const AttributeResult& a : result.attributes)
    print_line("  {} \"{}\": {} bytes, max error {:.3g} of {:.3g}", name_of(a.kind), a.name,
               grouped(a.bytes), a.max_error, a.asked);
}

}  // namespace anicodec::tools
