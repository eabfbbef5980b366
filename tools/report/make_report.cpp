// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "codec/keyframes/keyframe_fit.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"
#include "codec/sequence/frame_source.h"
#include "codec/surface/closest_point.h"
#include "format/container.h"
#include "tools/inputs/played_clip.h"
#include "tools/peers/cubic_grid.h"
#include "tools/peers/draco_frames.h"
#include "tools/peers/raw_cache.h"
#include "tools/render/shaded_view.h"
#include "tools/render/viewer_page.h"
#include "tools/report/report.h"
#include "tools/words/names.h"
#include "tools/words/version.h"
#if defined(ANICODEC_MESHOPTIMIZER)
#include "tools/peers/frame_deltas.h"
#endif

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

// KG errors in per cent, from coarse to fine.
constexpr double kQuickTargets[] = {1, 0.1};
constexpr double kLinearTargets[] = {1, 0.3, 0.1, 0.03};
constexpr double kKeyframeTargets[] = {3, 1, 0.3};
constexpr double kPeerTargets[] = {1, 0.1, 0.03};
constexpr double kShownKg = 0.1;
constexpr uint32_t kPictureSize = 320, kThumbnailSize = 200;
constexpr uint32_t kPictures = 3;
constexpr size_t kSheet = 8;  // key-frames on the contact sheet

class ReportMaker {
 public:
  ReportMaker(const MeshSequence& sequence, const ReportOptions& options)
      : sequence_(sequence), options_(options) {}

  Report make() {
    report_.name = sequence_.name;
    report_.vertices = sequence_.vertex_count;
    report_.faces = static_cast<uint32_t>(sequence_.polygons.size());
    report_.frames = sequence_.frame_count;
    report_.rate = sequence_.rate;
    report_.diagonal = diagonal(sequence_);
    Stages stages;
    for (double kg : options_.full ? std::span<const double>(kLinearTargets) : kQuickTargets)
      stages.push_back([=, this] { add_encoding("anicodec", BasisChoice::kAuto, kg); });
    if (options_.full)
      measure_others(stages);
    parallel_tasks(stages.size(), [&](size_t i) { stages[i](); });
    // Curves want their points in order.
    std::ranges::stable_sort(report_.rates, [](const RatePoint& a, const RatePoint& b) {
      const bool own = is_own(a.codec);
      return own != is_own(b.codec) ? own
             : a.codec != b.codec   ? a.codec < b.codec
                                    : a.bytes < b.bytes;
    });
    if (options_.full) {
      begin("key-frames");
      KeyframeFitter fitter{FrameView(sequence_)};
      report_.basis_errors = basis_errors(fitter, options_.counts);
      draw_keyframes(fitter);
      begin("shape spaces");
      report_.shape_spaces = shape_space_errors(sequence_, options_.counts);
    }
    return std::move(report_);
  }

 private:
  using Stages = std::vector<std::function<void()>>;

  void measure_others(Stages& stages) {
    for (double kg : kKeyframeTargets)
      stages.push_back(
          [=, this] { add_encoding("anicodec, key-frames", BasisChoice::kKeyframes, kg); });
    for (double kg : kPeerTargets)
      stages.push_back([=, this] { add_peers(kg); });
    stages.push_back([this] { add_raw_cache(); });
  }

  void begin(const char* stage) {
    constexpr double kAll =
        std::size(kLinearTargets) + std::size(kKeyframeTargets) + std::size(kPeerTargets) + 3;
    const double stages = options_.full ? kAll : double{std::size(kQuickTargets)};
    const std::lock_guard<std::mutex> lock(mutex_);
    if (options_.progress)
      options_.progress(stage, stage_ / stages);
    ++stage_;
  }

  void add(RatePoint point) {
    const std::lock_guard<std::mutex> lock(mutex_);
    report_.rates.push_back(std::move(point));
  }

  double bpfv(uint64_t bytes) const {
    return 8 * static_cast<double>(bytes) /
           (static_cast<double>(sequence_.vertex_count) * sequence_.frame_count);
  }

  Comparison compared(const FrameSource& frames) const {
    return compare(sequence_.polygons, sequence_.vertex_count, sequence_.frame_count,
                   frames_of(sequence_), frames);
  }

  RatePoint point(const std::string& codec, uint64_t bytes, const Comparison& c) const {
    return {codec, bytes, bpfv(bytes), c.kg, c.percent(c.max_error), c.sted.sted};
  }

  void add_encoding(const std::string& codec, BasisChoice basis, double kg) {
    begin("encoding");
    EncodeOptions options;
    options.target = {ErrorMetric::kKg, kg, false};
    options.basis = basis;
    options.effort = options_.effort;
    options.attributes.keep = false;  // the other codecs have positions and faces alone, too
    options.encoder = std::string("anicodec ") + version();
    EncodeResult result;
    try {
      result = encode(sequence_, options);
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::kUsage)
        throw;
      return;  // this clip cannot be coded so
    }
    const PlayedClip clip("the encoded clip", result.file);
    FrameSource frames = clip.play({0});
    const Comparison comparison = compared(frames);
    add(point(codec, result.file.size(), comparison));
    if (basis == BasisChoice::kAuto && kg == kShownKg) {
      report_.shown_kg = kg;
      report_.shown_bytes = result.file.size();
      report_.shown = comparison;
      add_shares(result.file);
      add_player(result.file);
      draw_frames(frames);
    }
  }

  void add_player(const Bytes& file) {
    const std::string viewer = find_viewer();
    if (viewer.empty() || !can_draw())
      return;
    const PageClip clip[] = {{sequence_.name.empty() ? "clip" : sequence_.name,
                              {reinterpret_cast<const char*>(file.data()), file.size()}}};
    report_.player = viewer_page(viewer, clip);
  }

  void add_shares(const Bytes& file) {
    static const std::map<std::string, std::string> kNames = {{"MESH", "connectivity and poses"},
                                                              {"POSE", "reference pose"},
                                                              {"SEGM", "time weights"},
                                                              {"BASI", "basis"},
                                                              {"CORR", "corrections"},
                                                              {"VMAP", "vertex order"},
                                                              {"FMAP", "order of faces"}};
    ContainerReader reader;
    if (!reader.open(file).ok())
      return;
    std::map<std::string, uint64_t> bytes;
    uint64_t known = 0;
    for (const Chunk& chunk : reader.chunks()) {
      const auto found = kNames.find(chunk_name(chunk.type));
      if (found == kNames.end())
        continue;
      bytes[found->second] += chunk.size;
      known += chunk.size;
    }
    bytes["table and metadata"] = file.size() - known;
    for (const auto& [what, size] : bytes)
      report_.shares.push_back({what, size});
    std::ranges::sort(report_.shares, std::greater<>(), &ByteShare::bytes);
  }

  void add_peers(double kg) {
    begin("other codecs");
    peers::GriddedClip grid;
    try {
      grid = peers::on_grid_at_kg(sequence_, kg);
    } catch (const Error&) {
      return;  // too fine for it
    }
    std::vector<float> positions(size_t{3} * sequence_.vertex_count);
    const Comparison comparison = compared([&](uint32_t f) -> std::span<const float> {
      const uint32_t* values = grid.values.data() + positions.size() * f;
      for (size_t i = 0; i < positions.size(); ++i)
        positions[i] = static_cast<float>(grid.origin[i % 3] + grid.step * values[i]);
      return positions;
    });
    const std::vector<uint32_t> triangles = fan_triangles(sequence_.polygons);
    if (triangles.empty())
      return;
    try {
      const peers::DracoFrames draco = peers::draco_on_grid(sequence_, triangles, grid);
      add(point("Draco, every frame", draco.bytes(), comparison));
    } catch (const Error&) {  // a mesh that Draco does not take
    }
#if defined(ANICODEC_MESHOPTIMIZER)
    const peers::FrameDeltaSize deltas =
        peers::frame_delta_size(grid, sequence_.vertex_count, triangles);
    add(point("frame deltas, meshoptimizer, zstd", deltas.bytes, comparison));
#endif
  }

  void add_raw_cache() {
    begin("other codecs");
    const peers::RawCacheSize size = peers::raw_cache_size(sequence_);
    for (const auto& [codec, bytes] :
         {std::pair("float32 cache", size.raw), std::pair("float32 cache, zstd", size.zstd),
          std::pair("float32 cache, xz", size.xz)})
      add({codec, bytes, bpfv(bytes)});
  }

  bool can_draw() const {
    return !fan_triangles(sequence_.polygons).empty();
  }

  Camera camera() const {
    Camera camera;
    camera.z_up = sequence_.up == UpAxis::kZ;
    return camera;
  }

  /// The frame with the largest error, and others spread over the clip.
  void draw_frames(const FrameSource& frames) {
    if (!can_draw())
      return;
    std::vector<uint32_t> chosen = {report_.shown.max_frame};
    for (uint32_t i = 0; i + 1 < kPictures; ++i)
      chosen.push_back(static_cast<uint32_t>((2 * i + 1) * uint64_t{sequence_.frame_count} /
                                             (2 * (kPictures - 1))));
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (uint32_t f : chosen) {
      std::span<const float> original = sequence_.frame(f), decoded = frames(f);
      Box around;
      around.add(original);
      ShadedView view(sequence_, around, kPictureSize, kPictureSize);
      std::vector<float> colours;
      for (size_t v = 0; v < sequence_.vertex_count; ++v) {
        double squared = 0;
        for (size_t i = 3 * v; i < 3 * v + 3; ++i)
          squared += std::pow(double{original[i]} - double{decoded[i]}, 2);
        const double share =
            report_.shown.max_error > 0 ? std::sqrt(squared) / report_.shown.max_error : 0;
        const std::array<float, 3> colour = error_colour(share);
        colours.insert(colours.end(), colour.begin(), colour.end());
      }
      Image image(3 * kPictureSize, kPictureSize);
      image.paste(view.draw(original, camera()), 0, 0);
      image.paste(view.draw(decoded, camera()), kPictureSize, 0);
      image.paste(view.draw(decoded, camera(), colours), 2 * kPictureSize, 0);
      report_.pictures.push_back(
          {fmt::format("Frame {}{}", f,
                       f == report_.shown.max_frame ? ", which has the largest error" : ""),
           std::move(image)});
    }
  }

  void draw_keyframes(KeyframeFitter& fitter) {
    if (!can_draw())
      return;
    const size_t count = std::min<size_t>(kSheet, sequence_.frame_count);
    KeyframeFit fit = fitter.fit(count, KeyframeMethod::kPivot, KeyframeWeights::kLinear);
    std::ranges::sort(fit.keyframes);
    for (uint32_t f : fit.keyframes) {
      Box around;
      around.add(sequence_.frame(f));
      ShadedView view(sequence_, around, kThumbnailSize, kThumbnailSize);
      report_.keyframes.push_back(
          {fmt::format("frame {}", f), view.draw(sequence_.frame(f), camera())});
    }
  }

  const MeshSequence& sequence_;
  const ReportOptions& options_;
  std::mutex mutex_;
  Report report_;  ///< of what runs side by side, only `rates` is written by more than one
  double stage_ = 0;
};

}  // namespace

Report make_report(const MeshSequence& sequence, const ReportOptions& options) {
  check(sequence);
  return ReportMaker(sequence, options).make();
}

nlohmann::ordered_json report_json(const Report& report) {
  nlohmann::ordered_json json = {{"name", report.name},
                                 {"vertices", report.vertices},
                                 {"faces", report.faces},
                                 {"frames", report.frames},
                                 {"frame_rate", report.rate.value()},
                                 {"diagonal", report.diagonal}};
  json["rates"] = nlohmann::ordered_json::array();
  for (const RatePoint& p : report.rates)
    json["rates"].push_back({{"codec", p.codec},
                             {"bytes", p.bytes},
                             {"bpfv", p.bpfv},
                             {"kg", p.kg},
                             {"max_error_percent", p.max_error_percent},
                             {"sted", p.sted}});
  json["shown_kg"] = report.shown_kg;
  json["shown_bytes"] = report.shown_bytes;
  json["shares"] = nlohmann::ordered_json::object();
  for (const ByteShare& share : report.shares)
    json["shares"][share.what] = share.bytes;
  json["frame_errors"] = nlohmann::ordered_json::array();
  for (const FrameError& e : report.shown.frames)
    json["frame_errors"].push_back({{"rmse", e.rmse}, {"max_error", e.max}});
  json["basis_errors"] = nlohmann::ordered_json::array();
  for (const BasisError& e : report.basis_errors)
    json["basis_errors"].push_back(
        {{"method", e.method}, {"k", e.k}, {"kg", e.kg}, {"rmse", e.rmse}});
  json["shape_spaces"] = nlohmann::ordered_json::array();
  for (const ShapeSpaceError& e : report.shape_spaces)
    json["shape_spaces"].push_back({{"space", e.space},
                                    {"k", e.k},
                                    {"kg", e.kg},
                                    {"numbers", e.numbers},
                                    {"bytes", e.bytes},
                                    {"residual_percent", e.residual_percent}});
  if (report.massage)
    json["massage"] = massage_json(*report.massage);
  return json;
}

}  // namespace anicodec::tools
