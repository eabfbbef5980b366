// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/clip.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"
#include "tools/inputs/clip_input.h"
#include "tools/words/names.h"

#include <algorithm>
#include <string_view>

namespace anicodec::bench {
namespace {

void open(const Bytes& file, Clip& clip, DecodingTrace* trace = nullptr) {
  OpenOptions options;
  options.trace = trace;
  if (Failure failure = clip.open(file, options); !failure.ok())
    tools::fail_clip("the encoded clip", failure);
}

/// When the steps of opening end.
class Steps : public DecodingTrace {
 public:
  void step(const char* name, const int32_t*, size_t) override {
    const std::string_view step = name;
    const double now = watch_.seconds();
    if (step == "residuals")
      reading += now - last_;
    else if (step == "coefficients" && !predicted_)
      predicting += now - last_;
    else if (step == "vertex of each rank")
      ordering += now - last_;
    predicted_ = step == "coefficients";
    last_ = watch_.seconds();
  }

  double ordering = 0, reading = 0, predicting = 0;  ///< seconds of all segments

 private:
  Stopwatch watch_{CLOCK_THREAD_CPUTIME_ID};
  double last_ = 0;
  bool predicted_ = false;
};

double coefficients(const Clip& clip) {
  double count = 0;
  for (const Limits::Segment& s : clip.limits().segments)
    count += static_cast<double>(clip.limits().meshes[s.mesh].coded_vertices) * s.components *
             (s.kind == BasisKind::kEigentrajectories ? 1 : 3);
  return count;
}

}  // namespace

Table run_open(const BenchOptions& options, double kg, int runs) {
  Table table({{"clip", "clip", ""},
               {"open", "--open", ""},
               {"components", "k", ""},
               {"bytes", "bytes", ""},
               {"growth", "more %", "{:.1f}"},
               {"open_ms", "open ms", "{:.1f}"},
               {"gain", "gain", "{:.2f}"},
               {"order_ms", "order ms", "{:.1f}"},
               {"read_ms", "read ms", "{:.1f}"},
               {"read_ns", "ns/coefficient", "{:.1f}"},
               {"predict_ms", "predict ms", "{:.1f}"},
               {"predict_ns", "ns/coefficient", "{:.1f}"}});
  constexpr std::pair<OpeningChoice, const char*> kChoices[] = {{OpeningChoice::kSmall, "small"},
                                                                {OpeningChoice::kAuto, "auto"},
                                                                {OpeningChoice::kFast, "fast"}};
  for (const std::string& name : options.clips) {
    double bytes = 0, seconds = 0;  // of the smallest file
    for (const auto& [choice, word] : kChoices) {
      const TimedEncode timed =
          encode_timed(load_clip(name), {ErrorMetric::kKg, kg, false}, options.basis,
                       options.effort, options.verbose, OrderMode::kFree, choice);
      const Bytes& file = timed.result.file;
      const double opening = median_thread_seconds(runs, [&] {
        Clip clip;
        open(file, clip);
      });
      std::vector<Steps> all(static_cast<size_t>(runs));
      Clip clip;
      for (Steps& steps : all) {
        Clip again;
        open(file, again, &steps);
      }
      open(file, clip);
      const auto median = [&](double Steps::*of) {
        std::ranges::sort(all, {}, of);
        return all[all.size() / 2].*of;
      };
      const double ordering = median(&Steps::ordering), reading = median(&Steps::reading),
                   predicting = median(&Steps::predicting);
      if (choice == OpeningChoice::kSmall) {
        bytes = static_cast<double>(file.size());
        seconds = opening;
      }
      table.add({{"clip", name},
                 {"open", word},
                 {"basis", tools::name_of(timed.result.kind)},
                 {"components", timed.result.components},
                 {"bytes", file.size()},
                 {"growth", 100 * (static_cast<double>(file.size()) / bytes - 1)},
                 {"open_ms", 1e3 * opening},
                 {"gain", seconds / opening},
                 {"order_ms", 1e3 * ordering},
                 {"read_ms", 1e3 * reading},
                 {"read_ns", 1e9 * reading / coefficients(clip)},
                 {"predict_ms", 1e3 * predicting},
                 {"predict_ns", 1e9 * predicting / coefficients(clip)}});
    }
  }
  return table;
}

}  // namespace anicodec::bench
