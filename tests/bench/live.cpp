// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"
#include "codec/encode_live.h"
#include "codec/file/live_stream.h"
#include "sdk/clip/kept_learning.h"
#include "sdk/clip/kept_meshes.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"

#include <algorithm>
#include <utility>

namespace anicodec::bench {
namespace {

/// The files of a live stream, each of so many frames.
std::vector<Bytes> live_files(MeshSequence sequence, size_t frames, double key_every,
                              const EncodeOptions& options) {
  const FrameArray positions = std::move(sequence.positions);
  sequence.positions = {};
  const size_t frame = size_t{3} * sequence.vertex_count;
  LiveEncoder encoder(std::move(sequence), options, key_every);
  std::vector<Bytes> files;
  for (size_t at = 0; at < positions.size(); at += frames * frame) {
    const auto begin = positions.begin() + static_cast<ptrdiff_t>(at);
    const size_t size = std::min(frames * frame, positions.size() - at);
    files.push_back(encoder.encode({begin, begin + static_cast<ptrdiff_t>(size)}).file);
  }
  return files;
}

/// The clip in one file, with as long a search as the files of a stream have.
Bytes whole_clip(MeshSequence sequence, EncodeOptions options) {
  options.effort = less(options.effort);
  options.bounds = false;  // those of a stream have none
  return encode(std::move(sequence), options).file;
}

}  // namespace

Table run_live(const BenchOptions& options, const Target& target, uint32_t frames, double key_every,
               int runs) {
  Table table({{"clip", "clip", ""},
               {"vertices", "vertices", ""},
               {"frames", "frames a file", ""},
               {"files", "files", ""},
               {"bytes", "bytes", ""},
               {"kbits", "kbit/s", "{:.0f}"},
               {"whole_bytes", "whole clip", ""},
               {"times", "stream : whole", "{:.2f}"},
               {"encode_seconds", "encode s a file", "{:.2f}"},
               {"first_ms", "open first ms", "{:.1f}"},
               {"next_ms", "open next ms", "{:.1f}"},
               {"whole_ms", "with its meshes ms", "{:.1f}"},
               {"ratio", "next : with meshes", "{:.2f}"}});
  for (const std::string& name : options.clips) {
    EncodeOptions encoding;
    encoding.basis = options.basis;
    encoding.effort = options.effort;
    MeshSequence sequence = load_clip(name);
    encoding.target = {target.metric, bound_of(target, diagonal(sequence)).value, false};
    const uint32_t vertices = sequence.vertex_count;
    constexpr double kUsual = 30;  // frames a second, where nobody knows
    const double seconds =
        sequence.frame_count / (sequence.rate.assumed ? kUsual : sequence.rate.value());
    const size_t whole_bytes = whole_clip(sequence, encoding).size();
    const Stopwatch watch(CLOCK_MONOTONIC);
    const std::vector<Bytes> files = live_files(std::move(sequence), frames, key_every, encoding);
    const double encode_seconds = watch.seconds() / static_cast<double>(files.size());
    Bytes stream;
    for (const Bytes& file : files)
      stream.insert(stream.end(), file.begin(), file.end());
    const std::vector<Bytes> whole = read_live_stream({name, stream}).files;

    enum : size_t { kFirst, kNext, kWhole };

    const auto rest = static_cast<double>(std::max<size_t>(files.size(), 2) - 1);
    KeptMeshes kept;
    KeptLearning learning, of_whole, after_first;
    OpenOptions keeping, with_meshes;
    keeping.kept = &kept;
    keeping.learning = &learning;
    with_meshes.learning = &after_first;
    opening_of(whole[0], with_meshes)();
    with_meshes.learning = &of_whole;
    const Turns turns(
        runs,
        [&] {
          kept.clear();
          learning.clear();
          opening_of(whole[0], keeping)();
        },
        [&] {
          for (size_t i = 1; i < whole.size(); ++i)
            opening_of(whole[i], keeping)();
        },
        [&] {
          of_whole = after_first;
          for (size_t i = 1; i < whole.size(); ++i)
            opening_of(whole[i], with_meshes)();
        });
    table.add({{"clip", name},
               {"vertices", vertices},
               {"frames", frames},
               {"files", files.size()},
               {"bytes", stream.size()},
               {"kbits", 8e-3 * static_cast<double>(stream.size()) / seconds},
               {"whole_bytes", whole_bytes},
               {"times", static_cast<double>(stream.size()) / static_cast<double>(whole_bytes)},
               {"encode_seconds", encode_seconds},
               {"first_ms", 1e3 * turns.seconds(kFirst)},
               {"next_ms", 1e3 * turns.seconds(kNext) / rest},
               {"whole_ms", 1e3 * turns.seconds(kWhole) / rest},
               {"ratio", files.size() > 1 ? turns.ratio(kNext, kWhole) : 0}});
  }
  return table;
}

}  // namespace anicodec::bench
