// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/linear_steps.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"

namespace anicodec::bench {
namespace {

uint64_t encoded_bytes(const std::string& clip, EncodeOptions options) {
  return encode(load_clip(clip), options).file.size();
}

}  // namespace

Table run_ablate(const BenchOptions& options, double kg, const std::vector<std::string>& means) {
  Table table({{"clip", "clip", ""},
               {"without", "without", ""},
               {"bytes", "bytes", ""},
               {"growth", "growth %", "{:.2f}"}});
  for (const std::string& clip : options.clips) {
    EncodeOptions search;
    search.target = {ErrorMetric::kKg, kg, false};
    search.basis = options.basis;
    search.effort = options.effort;
    search.order = OrderMode::kFree;
    const uint64_t all = encoded_bytes(clip, search);
    table.add({{"clip", clip}, {"without", "nothing"}, {"bytes", all}, {"growth", 0.0}});
    for (const std::string& mean : means.empty() ? search_means() : means) {
      search.without = {mean};
      const uint64_t bytes = encoded_bytes(clip, search);
      const double growth = 100 * (static_cast<double>(bytes) / static_cast<double>(all) - 1);
      table.add({{"clip", clip}, {"without", mean}, {"bytes", bytes}, {"growth", growth}});
    }
  }
  return table;
}

}  // namespace anicodec::bench
