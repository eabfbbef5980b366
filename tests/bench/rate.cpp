// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/closest_point.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tools/peers/cubic_grid.h"
#include "tools/peers/frame_deltas.h"
#include "tools/peers/raw_cache.h"
#include "tools/words/names.h"

#include <cmath>

namespace anicodec::bench {
namespace {

using nlohmann::ordered_json;

double ratio(uint64_t other, uint64_t ours) {
  return static_cast<double>(other) / static_cast<double>(ours);
}

/// The part of a row about the encoded file.
ordered_json describe(const std::string& clip, const MeshSequence& sequence,
                      const TimedEncode& timed) {
  const EncodeResult& result = timed.result;
  ByteShares shares = byte_shares(result.file);
  return {{"clip", clip},
          {"vertices", sequence.vertex_count},
          {"frames", sequence.frame_count},
          {"bytes", result.file.size()},
          {"bpfv", bpfv(result.file.size(), sequence)},
          {"basis", tools::name_of(result.kind)},
          {"components", result.components},
          {"kg", result.kg},
          {"max_error_percent", 100 * result.max_error / result.diagonal},
          {"mesh_bytes", shares.mesh},
          {"pose_bytes", shares.pose},
          {"weights_bytes", shares.weights},
          {"basis_bytes", shares.basis},
          {"corrections_bytes", shares.corrections},
          {"rest_bytes", shares.rest},
          {"encode_seconds", timed.wall_seconds},
          {"encode_cpu_seconds", timed.cpu_seconds},
          {"stages", timed.stages}};
}

const std::vector<Table::Column> kShares = {
    {"mesh_bytes", "mesh", ""},         {"pose_bytes", "pose", ""},
    {"weights_bytes", "weights", ""},   {"basis_bytes", "basis", ""},
    {"corrections_bytes", "corr.", ""}, {"rest_bytes", "rest", ""},
    {"encode_seconds", "s", "{:.1f}"},  {"encode_cpu_seconds", "CPU s", "{:.1f}"}};

std::vector<Table::Column> columns_with_shares(std::vector<Table::Column> first,
                                               const std::vector<Table::Column>& last) {
  first.insert(first.end(), kShares.begin(), kShares.end());
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

}  // namespace

Table run_rate(const BenchOptions& options, const std::vector<double>& targets) {
  Table table(columns_with_shares({{"clip", "clip", ""},
                                   {"asked_kg", "KG asked", "{:g}"},
                                   {"kg", "KG", "{:.4f}"},
                                   {"bytes", "bytes", ""},
                                   {"bpfv", "bpfv", "{:.3f}"},
                                   {"basis", "kind", ""},
                                   {"components", "k", ""}},
                                  {{"zstd_bytes", "float32 zstd", ""},
                                   {"zstd_ratio", "ratio", "{:.0f}"},
                                   {"xz_bytes", "float32 xz", ""},
                                   {"xz_ratio", "ratio", "{:.0f}"}}));
  for (const std::string& clip : options.clips) {
    MeshSequence sequence = load_clip(clip);
    const RawCacheSize cache = raw_cache_size(sequence);
    for (double kg : targets) {
      Target target{ErrorMetric::kKg, kg, false};
      TimedEncode timed =
          encode_timed(sequence, target, options.basis, options.effort, options.verbose);
      uint64_t bytes = timed.result.file.size();
      ordered_json row = describe(clip, sequence, timed);
      row["asked_kg"] = kg;
      row["zstd_bytes"] = cache.zstd;
      row["zstd_ratio"] = ratio(cache.zstd, bytes);
      row["xz_bytes"] = cache.xz;
      row["xz_ratio"] = ratio(cache.xz, bytes);
      table.add(std::move(row));
    }
  }
  return table;
}

Table run_near(const BenchOptions& options, double max_error_percent) {
  Table table(columns_with_shares({{"clip", "clip", ""},
                                   {"asked_percent", "asked %", "{:g}"},
                                   {"max_error_percent", "max error %", "{:.5f}"},
                                   {"bytes", "bytes", ""},
                                   {"bpfv", "bpfv", "{:.3f}"},
                                   {"basis", "kind", ""},
                                   {"components", "k", ""}},
                                  {{"grid_max_error_percent", "grid max error %", "{:.5f}"},
                                   {"deltas_bytes", "deltas bytes", ""},
                                   {"deltas_bpfv", "bpfv", "{:.3f}"},
                                   {"deltas_ratio", "ratio", "{:.2f}"}}));
  for (const std::string& clip : options.clips) {
    MeshSequence sequence = load_clip(clip);
    Target target{ErrorMetric::kMaxError, max_error_percent, true};
    TimedEncode timed =
        encode_timed(sequence, target, options.basis, options.effort, options.verbose);
    // Half the diagonal of a cell is the largest error.
    double bound = max_error_percent / 100 * diagonal(sequence);
    GriddedClip grid = on_grid(sequence, 2 * bound / std::sqrt(3.0));
    FrameDeltaSize deltas =
        frame_delta_size(grid, sequence.vertex_count, fan_triangles(sequence.polygons));
    ordered_json row = describe(clip, sequence, timed);
    row["asked_percent"] = max_error_percent;
    row["grid_max_error_percent"] = 100 * grid.error.max_error / grid.error.diagonal;
    row["deltas_bytes"] = deltas.bytes;
    row["deltas_variant"] = deltas.variant;
    row["deltas_bpfv"] = bpfv(deltas.bytes, sequence);
    row["deltas_ratio"] = ratio(deltas.bytes, timed.result.file.size());
    table.add(std::move(row));
  }
  return table;
}

}  // namespace anicodec::bench
