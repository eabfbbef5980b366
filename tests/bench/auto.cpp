// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tools/words/names.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

namespace anicodec::bench {

Table run_auto(const BenchOptions& options, double kg) {
  struct Kind {
    BasisChoice choice;
    BasisKind kind;
  };

  constexpr Kind kKinds[] = {{BasisChoice::kKeyframes, BasisKind::kKeyframes},
                             {BasisChoice::kEigenshapes, BasisKind::kEigenshapes},
                             {BasisChoice::kEigentrajectories, BasisKind::kEigentrajectories}};
  Table table({{"clip", "clip", ""},
               {"keyframes", "keyframes", ""},
               {"eigenshapes", "eigenshapes", ""},
               {"eigentrajectories", "eigentrajectories", ""},
               {"auto", "auto", ""},
               {"basis", "kind", ""},
               {"excess_percent", "auto over best %", "{:.2f}"},
               {"auto_seconds", "auto s", "{:.1f}"},
               {"auto_cpu_seconds", "CPU s", "{:.1f}"}});
  Target target{ErrorMetric::kKg, kg, false};
  for (const std::string& clip : options.clips) {
    MeshSequence sequence = load_clip(clip);
    nlohmann::ordered_json row{{"clip", clip}};
    auto best = static_cast<double>(SIZE_MAX);
    for (const Kind& kind : kKinds) {
      try {
        TimedEncode timed =
            encode_timed(sequence, target, kind.choice, options.effort, options.verbose);
        row[tools::name_of(kind.kind)] = timed.result.file.size();
        row[fmt::format("{}_cpu_seconds", tools::name_of(kind.kind))] = timed.cpu_seconds;
        best = std::min(best, static_cast<double>(timed.result.file.size()));
      } catch (const Error& e) {
        if (e.kind() != ErrorKind::kUsage)
          throw;
        row[tools::name_of(kind.kind)] = nullptr;  // does not reach the error
      }
    }
    TimedEncode timed =
        encode_timed(sequence, target, BasisChoice::kAuto, options.effort, options.verbose);
    auto bytes = static_cast<double>(timed.result.file.size());
    row["auto"] = timed.result.file.size();
    row["basis"] = tools::name_of(timed.result.kind);
    row["excess_percent"] = 100 * (bytes / best - 1);
    row["auto_seconds"] = timed.wall_seconds;
    row["auto_cpu_seconds"] = timed.cpu_seconds;
    table.add(std::move(row));
  }
  return table;
}

}  // namespace anicodec::bench
