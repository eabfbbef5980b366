// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "format/container.h"
#include "sdk/clip/file_checks.h"
#include "sdk/clip/kept_meshes.h"
#include "sdk/clip/memory_estimate.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"
#include "tools/words/names.h"

#include <anicodec/anicodec.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace anicodec::bench {
namespace {

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

/// Memory that is mapped before anything is opened in it, as a host that keeps a block has it.
class MappedMemory {
 public:
  explicit MappedMemory(size_t size) : size_(size) {
    block_ = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE,
                  -1, 0);
    if (block_ == MAP_FAILED || anic_init_block_allocator(block_, size, &allocator_) != ANIC_OK)
      throw Error(ErrorKind::kInternal, "no memory");
    memory_ = {allocator_.user, allocator_.allocate, allocator_.release};
  }

  ~MappedMemory() { munmap(block_, size_); }

  MappedMemory(const MappedMemory&) = delete;
  MappedMemory& operator=(const MappedMemory&) = delete;

  Memory* memory() { return &memory_; }

 private:
  size_t size_;
  void* block_;
  anic_allocator allocator_;
  Memory memory_;
};

int64_t minor_faults() {
  rusage usage;
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt;
}

/// Memory that opening takes.
struct MemoryUse {
  double per_coefficient = 0;  ///< bytes at the peak
  int64_t faults = 0, faults_mapped = 0;
  double mapped_seconds = 0;
};

double coefficients(const Clip& clip) {
  double count = 0;
  for (const Limits::Segment& s : clip.limits().segments)
    count += static_cast<double>(clip.limits().meshes[s.mesh].coded_vertices) * s.components *
             (s.kind == BasisKind::kEigentrajectories ? 1 : 3);
  return count;
}

MemoryUse memory_use(ByteView file, int runs) {
  MemoryUse use;
  malloc_trim(0);
  int64_t before = minor_faults();
  {
    Clip clip;
    open_encoded(file, clip);
    use.faults = minor_faults() - before;
  }
  Limits limits;
  OpenOptions options;
  ContainerReader container;
  if (!container.open(file).ok() || !read_limits(container, options, &limits).ok())
    throw Error(ErrorKind::kInternal, "the encoded file cannot be read");
  MappedMemory mapped(estimate_memory(limits).opening * 3 / 2 + (size_t{1} << 20));
  const MemoryScope scope(mapped.memory());
  use.mapped_seconds = median_thread_seconds(runs, [&] {
    before = minor_faults();
    Clip clip;
    open_encoded(file, clip);
    use.faults_mapped = minor_faults() - before;
    use.per_coefficient = static_cast<double>(mapped.memory()->peak) / coefficients(clip);
  });
  return use;
}

}  // namespace

Table run_open(const BenchOptions& options, double kg, int runs) {
  Table table({{"clip", "clip", ""},
               {"search", "search", ""},
               {"components", "k", ""},
               {"bytes", "bytes", ""},
               {"growth", "more %", "{:.1f}"},
               {"open_ms", "open ms", "{:.1f}"},
               {"gain", "gain", "{:.2f}"},
               {"mapped_ms", "in a block ms", "{:.1f}"},
               {"base_ms", "base ms", "{:.1f}"},
               {"base_share", "of open", "{:.2f}"},
               {"layer_ms", "first layer ms", "{:.1f}"},
               {"layer_share", "of open", "{:.2f}"},
               {"stream_ms", "both and all of a stream ms", "{:.1f}"},
               {"stream_share", "of open", "{:.2f}"},
               {"faults", "faults", ""},
               {"faults_mapped", "in a block", ""},
               {"peak", "bytes/coefficient", "{:.1f}"},
               {"order_ms", "order ms", "{:.1f}"},
               {"read_ms", "read ms", "{:.1f}"},
               {"read_ns", "ns/coefficient", "{:.1f}"},
               {"predict_ms", "predict ms", "{:.1f}"},
               {"predict_ns", "ns/coefficient", "{:.1f}"}});
  for (const std::string& name : options.clips) {
    double bytes = 0, seconds = 0;  // of the smallest file
    for (const bool smallest : {true, false}) {
      const TimedEncode timed =
          encode_timed(load_clip(name), {ErrorMetric::kKg, kg, false}, options.basis,
                       options.effort, options.verbose, OrderMode::kFree, smallest);
      const Bytes& file = timed.result.file;
      const ByteView base = up_to_the_first("SEGM", file), layer = up_to_the_first("BASI", file);

      enum : size_t { kOpening, kBase, kLayer, kStream };

      const Turns turns(runs, opening_of(file), opening_of_prefix(base), opening_of_prefix(layer),
                        [&] {
                          KeptMeshes kept;
                          OpenOptions more;
                          more.prefix = true;
                          more.kept = &kept;
                          for (const ByteView arrived : {base, layer, ByteView(file)})
                            opening_of(arrived, more)();
                        });
      const double opening = turns.seconds(kOpening);
      const MemoryUse memory = memory_use(file, runs);
      std::vector<Steps> all(static_cast<size_t>(runs));
      Clip clip;
      for (Steps& steps : all) {
        OpenOptions traced;
        traced.trace = &steps;
        Clip again;
        open_encoded(file, again, traced);
      }
      open_encoded(file, clip);
      const auto median = [&](double Steps::*of) {
        std::ranges::sort(all, {}, of);
        return all[all.size() / 2].*of;
      };
      const double ordering = median(&Steps::ordering), reading = median(&Steps::reading),
                   predicting = median(&Steps::predicting);
      if (smallest) {
        bytes = static_cast<double>(file.size());
        seconds = opening;
      }
      table.add({{"clip", name},
                 {"search", smallest ? "smallest" : "balanced"},
                 {"basis", tools::name_of(timed.result.kind)},
                 {"components", timed.result.components},
                 {"bytes", file.size()},
                 {"growth", 100 * (static_cast<double>(file.size()) / bytes - 1)},
                 {"open_ms", 1e3 * opening},
                 {"gain", seconds / opening},
                 {"mapped_ms", 1e3 * memory.mapped_seconds},
                 {"base_ms", 1e3 * turns.seconds(kBase)},
                 {"base_share", turns.ratio(kBase, kOpening)},
                 {"layer_ms", 1e3 * turns.seconds(kLayer)},
                 {"layer_share", turns.ratio(kLayer, kOpening)},
                 {"stream_ms", 1e3 * turns.seconds(kStream)},
                 {"stream_share", turns.ratio(kStream, kOpening)},
                 {"faults", memory.faults},
                 {"faults_mapped", memory.faults_mapped},
                 {"peak", memory.per_coefficient},
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
