// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/massage.h"

#include "codec/encode.h"
#include "codec/massage/welded_surface.h"
#include "codec/metrics/hausdorff.h"
#include "codec/remesh/decimate.h"
#include "codec/surface/mesh_quality.h"
#include "codec/transfer/connectivity_transfer.h"
#include "codec/transfer/remesh_fit.h"
#include "corpus/sliding.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace anicodec::bench {
namespace {

constexpr uint64_t kSeed = 7;

EncodeOptions options_at(const BenchOptions& bench, double kg) {
  EncodeOptions options;
  options.target = {ErrorMetric::kKg, kg, false};
  options.effort = bench.effort;
  options.basis = bench.basis;
  options.order = OrderMode::kFree;
  return options;
}

void shorten(MeshSequence* clip, uint32_t frames) {
  if (frames == 0 || frames >= clip->frame_count)
    return;
  clip->frame_count = frames;
  clip->positions.resize(size_t{frames} * clip->vertex_count * 3);
  clip->times.clear();
}

/// Triangles that are turned in place on the surfaces in `after` but not in `before`, over all
/// frames.
uint64_t newly_turned(const MeshSequence& surfaces, const MeshSequence& before,
                      const MeshSequence& after) {
  const WeldedSurface clip(surfaces);
  uint64_t sum = 0;
  for (uint32_t f = 0; f < surfaces.frame_count; ++f) {
    const Surface surface(clip.topology, clip.frame(surfaces.frame(f)));
    const auto was = turned_in_place(clip.frame(before.frame(f)), surface);
    const auto is = turned_in_place(clip.frame(after.frame(f)), surface);
    std::vector<uint32_t> fresh;
    std::set_difference(is.begin(), is.end(), was.begin(), was.end(), std::back_inserter(fresh));
    sum += fresh.size();
  }
  return sum;
}

std::vector<float> positions_at(std::span<const uint32_t> vertices,
                                std::span<const float> positions) {
  std::vector<float> result;
  result.reserve(3 * vertices.size());
  for (uint32_t v : vertices)
    result.insert(result.end(), positions.begin() + 3 * v, positions.begin() + 3 * v + 3);
  return result;
}

/// A frame decimated to a share of its vertices.
Decimation decimated(const MeshSequence& clip, uint32_t f, double share) {
  DecimationOptions options;
  options.vertices = static_cast<uint32_t>(share * clip.vertex_count);
  return decimate({clip.polygons, {clip.frame(f).begin(), clip.frame(f).end()}}, options);
}

}  // namespace

Table run_massage_sliding(const BenchOptions& options, double kg, double edges, uint32_t frames) {
  Table table({{"clip", "clip", ""},
               {"clean_bytes", "clean", ""},
               {"sliding_ratio", "sliding : clean", "{:.2f}"},
               {"massaged_ratio", "massaged : clean", "{:.2f}"},
               {"noise_mean_percent", "noise mean %", "{:.4f}"},
               {"massaged_mean_percent", "massaged mean %", "{:.4f}"},
               {"noise_max_percent", "noise max %", "{:.3f}"},
               {"massaged_max_percent", "massaged max %", "{:.3f}"},
               {"turned", "turned", ""},
               {"turned_on_clean", "turned on clean", ""},
               {"drawn_back", "drawn back", ""},
               {"components", "components", "{:.1f}"},
               {"cpu_seconds_per_frame", "CPU s a frame", "{:.3f}"}});
  for (const std::string& word : options.clips) {
    MeshSequence clean = load_clip(word);
    shorten(&clean, frames);
    const MeshSequence sliding = corpus::slide_vertices(clean, edges, 0, kSeed);
    const Stopwatch watch(CLOCK_PROCESS_CPUTIME_ID);
    const MassageResult result = massage(sliding, {});
    const double seconds = watch.seconds();
    const SurfaceComparison noise = compare_surfaces(clean, sliding);
    const SurfaceComparison moved = compare_surfaces(clean, result.sequence);
    const auto size = [&](const MeshSequence& clip) {
      return static_cast<double>(encode(clip, options_at(options, kg)).file.size());
    };
    const double clean_bytes = size(clean);
    uint64_t drawn = 0;
    for (const MassagedFrame& frame : result.frames)
      drawn += frame.drawn_back;
    table.add({{"clip", word},
               {"clean_bytes", static_cast<uint64_t>(clean_bytes)},
               {"sliding_ratio", size(sliding) / clean_bytes},
               {"massaged_ratio", size(result.sequence) / clean_bytes},
               {"noise_mean_percent", noise.percent(noise.total.mean())},
               {"massaged_mean_percent", moved.percent(moved.total.mean())},
               {"noise_max_percent", noise.percent(noise.total.max())},
               {"massaged_max_percent", moved.percent(moved.total.max())},
               {"turned", newly_turned(sliding, sliding, result.sequence)},
               {"turned_on_clean", newly_turned(clean, sliding, result.sequence)},
               {"drawn_back", drawn},
               {"components", result.noise.components},
               {"cpu_seconds_per_frame", seconds / clean.frame_count}});
  }
  return table;
}

Table run_massage_auto(const BenchOptions& options, double kg) {
  Table table({{"clip", "clip", ""},
               {"sample_plain_bytes", "sample", ""},
               {"sample_massaged_bytes", "sample massaged", ""},
               {"massaged", "massaged", ""},
               {"bytes", "bytes", ""}});
  for (const std::string& word : options.clips) {
    EncodeOptions encoding = options_at(options, kg);
    encoding.massage.mode = MassageMode::kAuto;
    const EncodeResult result = encode(load_clip(word), encoding);
    const MassageVerdict& verdict = result.massage;
    table.add({{"clip", word},
               {"sample_plain_bytes", verdict.sample_plain_bytes},
               {"sample_massaged_bytes", verdict.sample_massaged_bytes},
               {"massaged", verdict.change ? "yes" : "no"},
               {"bytes", result.file.size()}});
  }
  return table;
}

Table run_massage_fit(const BenchOptions& options) {
  Table table({{"clip", "clip", ""},
               {"vertices", "vertices", ""},
               {"mean_ratio", "mean : start", "{:.3f}"},
               {"max_ratio", "max : start", "{:.3f}"},
               {"start_mean_percent", "start mean %", "{:.4f}"},
               {"turned_before", "turned before", ""},
               {"turned_after", "after", ""},
               {"cpu_seconds", "CPU s", "{:.2f}"}});
  for (const std::string& word : options.clips) {
    const MeshSequence clip = load_clip(word);
    const SurfaceFrame coarse = decimated(clip, 0, 0.25).mesh;
    SurfaceFrame fine{clip.polygons, {clip.frame(0).begin(), clip.frame(0).end()}};
    const Stopwatch watch(CLOCK_PROCESS_CPUTIME_ID);
    const RemeshFit fit = fit_remesh(coarse, fine);
    table.add({{"clip", word},
               {"vertices", coarse.positions.size() / 3},
               {"mean_ratio", fit.after.mean() / fit.before.mean()},
               {"max_ratio", fit.after.max() / fit.before.max()},
               {"start_mean_percent", 100 * fit.before.mean() / fit.diagonal},
               {"turned_before", fit.turned_before},
               {"turned_after", fit.turned_after},
               {"cpu_seconds", watch.seconds()}});
  }
  return table;
}

Table run_massage_transfer(const BenchOptions& options, uint32_t frames) {
  Table table({{"clip", "clip", ""},
               {"frames", "frames", ""},
               {"segments", "segments", ""},
               {"alarms", "alarms", ""},
               {"own_mean_percent", "decimation mean %", "{:.4f}"},
               {"kept_mean_percent", "first one moved mean %", "{:.4f}"},
               {"carried_mean_percent", "carried mean %", "{:.4f}"},
               {"carried_max_percent", "carried max %", "{:.3f}"},
               {"cpu_seconds_per_frame", "CPU s a frame", "{:.2f}"}});
  for (const std::string& word : options.clips) {
    MeshSequence clip = load_clip(word);
    shorten(&clip, frames);
    std::vector<Decimation> input;
    for (uint32_t f = 0; f < clip.frame_count; ++f)
      input.push_back(decimated(clip, f, 0.30 + 0.02 * (f % 4)));
    const Stopwatch watch(CLOCK_PROCESS_CPUTIME_ID);
    const TransferResult result =
        transfer_connectivity([&](uint32_t f) { return input[f].mesh; }, clip.frame_count, {});
    const double seconds = watch.seconds();
    double own = 0, kept = 0, carried = 0, largest = 0;
    for (const TransferSegment& segment : result.segments) {
      const Decimation& first = input[segment.first_frame];
      for (uint32_t k = 0; k < segment.sequence.frame_count; ++k) {
        const uint32_t f = segment.first_frame + k;
        auto from_clip = [&](const Polygons& polygons, std::span<const float> positions) {
          return hausdorff(polygons, positions, clip.polygons, clip.frame(f));
        };
        own += from_clip(input[f].mesh.polygons, input[f].mesh.positions).mean();
        kept += from_clip(first.mesh.polygons, positions_at(first.vertices, clip.frame(f))).mean();
        const HausdorffDistance distance =
            from_clip(segment.sequence.polygons, segment.sequence.frame(k));
        carried += distance.mean();
        largest = std::max(largest, distance.max());
      }
    }
    const double percent = 100 / result.diagonal, percent_a_frame = percent / clip.frame_count;
    std::string alarms;
    for (size_t f = 1; f < result.frames.size(); ++f) {
      if (result.frames[f].first)
        alarms += fmt::format("{}{} ({})", alarms.empty() ? "" : "; ", f,
                              alarm_names(result.frames[f].alarms));
    }
    table.add({{"clip", word},
               {"frames", clip.frame_count},
               {"segments", result.segments.size()},
               {"alarms", alarms.empty() ? "none" : alarms},
               {"own_mean_percent", percent_a_frame * own},
               {"kept_mean_percent", percent_a_frame * kept},
               {"carried_mean_percent", percent_a_frame * carried},
               {"carried_max_percent", percent * largest},
               {"cpu_seconds_per_frame", seconds / clip.frame_count}});
  }
  return table;
}

}  // namespace anicodec::bench
