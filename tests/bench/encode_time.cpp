// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

namespace anicodec::bench {
namespace {

/// The result of work in a child process, whose memory is that of this work alone.
nlohmann::ordered_json in_a_process(const std::function<nlohmann::ordered_json()>& work) {
  int ends[2];
  if (pipe(ends) != 0)
    throw Error(ErrorKind::kInternal, "no pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0)
    throw Error(ErrorKind::kInternal, "no process");
  if (child == 0) {
    close(ends[0]);
    int status = 0;
    try {
      const std::string text = work().dump();
      for (size_t done = 0; done < text.size();) {
        const ssize_t count = write(ends[1], text.data() + done, text.size() - done);
        if (count <= 0)
          _exit(1);
        done += static_cast<size_t>(count);
      }
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}\n", e.what());
      status = 1;
    }
    _exit(status);
  }
  close(ends[1]);
  std::string text;
  char part[4096];
  for (ssize_t count = 0; (count = read(ends[0], part, sizeof part)) > 0;)
    text.append(part, static_cast<size_t>(count));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0 || text.empty())
    throw Error(ErrorKind::kInternal, "an encoding ended without a result");
  return nlohmann::ordered_json::parse(text);
}

}  // namespace

Table run_encode(const BenchOptions& options, double kg, const std::vector<uint32_t>& vertices,
                 const std::vector<uint32_t>& frames) {
  Table table({{"clip", "clip", ""},
               {"vertices", "vertices", ""},
               {"frames", "frames", ""},
               {"threads", "threads", ""},
               {"bytes", "bytes", ""},
               {"seconds", "s", "{:.2f}"},
               {"cpu_seconds", "CPU s", "{:.2f}"},
               {"gain", "faster", "{:.2f}"},
               {"frames_per_second", "frames/s", "{:.1f}"},
               {"coordinate_ns", "CPU ns/coordinate", "{:.0f}"},
               {"memory_mb", "memory MB", "{:.0f}"},
               {"times_float32", "x float32", "{:.1f}"},
               {"growth", "x fewer frames", "{:.2f}"}});
  const unsigned all = std::max(1U, std::thread::hardware_concurrency());
  std::map<unsigned, double>
      of_fewer;  // CPU seconds of the clip before where it differs by its frames alone
  const auto rows_of = [&](const std::string& name, const std::function<MeshSequence()>& make) {
    double alone = 0;                // seconds of one thread
    std::map<unsigned, double> cpu;  // of this clip, by threads
    for (unsigned threads = 1; threads <= all; threads = threads < all ? all : all + 1) {
      nlohmann::ordered_json row = in_a_process([&] {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        MeshSequence clip = make();
        const auto coordinates = static_cast<double>(clip.positions.size());
        nlohmann::ordered_json found{{"clip", name},
                                     {"vertices", clip.vertex_count},
                                     {"frames", clip.frame_count},
                                     {"threads", threads}};
        const double count = clip.frame_count;
        const TimedEncode timed = encode_timed(std::move(clip), {ErrorMetric::kKg, kg, false},
                                               options.basis, options.effort, options.verbose);
        const auto memory = static_cast<double>(peak_memory());
        found["bytes"] = timed.result.file.size();
        found["seconds"] = timed.wall_seconds;
        found["cpu_seconds"] = timed.cpu_seconds;
        found["frames_per_second"] = count / timed.wall_seconds;
        found["coordinate_ns"] = 1e9 * timed.cpu_seconds / coordinates;
        found["memory_mb"] = memory / 1e6;
        found["times_float32"] = memory / (4 * coordinates);
        found["stages"] = timed.stages;
        return found;
      });
      const double seconds = row["seconds"];
      if (threads == 1)
        alone = seconds;
      row["gain"] = alone / seconds;
      cpu[threads] = row["cpu_seconds"];
      if (of_fewer.contains(threads))
        row["growth"] = cpu[threads] / of_fewer[threads];
      table.add(std::move(row));
    }
    of_fewer = cpu;
  };
  for (const std::string& word : options.clips) {
    of_fewer.clear();
    rows_of(word, [&] { return load_clip(word); });
  }
  if (options.clips.empty()) {
    for (const uint32_t n : vertices) {
      of_fewer.clear();
      for (const uint32_t f : frames)
        rows_of("limb", [&] { return corpus::make_scaled("limb", n, f); });
    }
  }
  return table;
}

}  // namespace anicodec::bench
