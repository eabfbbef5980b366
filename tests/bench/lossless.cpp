// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/container.h"
#include "sdk/clip/clip.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"
#include "tools/inputs/clip_input.h"
#include "tools/peers/raw_cache.h"

namespace anicodec::bench {
namespace {

/// Bytes of exact positions.
uint64_t exact_bytes(const Bytes& file) {
  ContainerReader reader;
  if (Failure failure = reader.open(file); !failure.ok())
    tools::fail_clip("the encoded clip", failure);
  uint64_t bytes = 0;
  for (const Chunk& chunk : reader.chunks())
    bytes += chunk.type == chunk_type("DIFF") ? chunk.size : 0;
  return bytes;
}

}  // namespace

Table run_lossless(const BenchOptions& options) {
  Table table({{"clip", "clip", ""},
               {"vertices", "vertices", ""},
               {"frames", "frames", ""},
               {"raw", "raw", ""},
               {"zstd", "zstd -19", ""},
               {"xz", "xz -9", ""},
               {"bytes", "anicodec", ""},
               {"exact", "exact", ""},
               {"factor", "xz / anicodec", "{:.2f}"},
               {"encode", "encode s", "{:.1f}"},
               {"open", "open s", "{:.2f}"}});
  for (const std::string& name : options.clips) {
    const MeshSequence sequence = load_clip(name);
    const RawCacheSize cache = raw_cache_size(sequence);
    const TimedEncode timed =
        encode_timed(sequence, {ErrorMetric::kMaxError, 0, false}, options.basis, options.effort,
                     options.verbose, OrderMode::kVertices);
    const Bytes& file = timed.result.file;
    const double seconds = median_thread_seconds(1, opening_of(file));
    table.add({{"clip", name},
               {"vertices", sequence.vertex_count},
               {"frames", sequence.frame_count},
               {"raw", cache.raw},
               {"zstd", cache.zstd},
               {"xz", cache.xz},
               {"bytes", file.size()},
               {"exact", exact_bytes(file)},
               {"factor", static_cast<double>(cache.xz) / static_cast<double>(file.size())},
               {"encode", timed.cpu_seconds},
               {"open", seconds}});
  }
  return table;
}

}  // namespace anicodec::bench
