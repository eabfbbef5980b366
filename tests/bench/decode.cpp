// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "corpus/clips.h"
#include "sdk/clip/clip.h"
#include "sdk/play/play.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/bench_encode.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"
#include "tools/peers/draco_frames.h"
#include "tools/words/names.h"

#include <utility>

namespace anicodec::bench {
namespace {

/// All frames, four in a pass as a player does that decodes ahead.
void play(const Clip& clip, std::vector<float>& positions) {
  constexpr uint32_t kPass = 4;
  const size_t size = size_t{3} * clip.vertex_count();
  positions.resize(kPass * size);
  for (const Segment& segment : clip.segments()) {
    for (uint32_t first = 0; first < segment.frames; first += kPass) {
      FrameState states[kPass];
      VertexOutput outputs[kPass];
      const uint32_t frames = std::min(kPass, segment.frames - first);
      for (uint32_t i = 0; i < frames; ++i) {
        states[i] = frame_state(segment, first + i);
        outputs[i].data = positions.data() + i * size;
      }
      play(states, frames, 0, segment.vertices, outputs);
    }
  }
}

}  // namespace

Table run_decode(const BenchOptions& options, double kg, int runs) {
  Table table({{"clip", "clip", ""},
               {"frames", "frames", ""},
               {"search", "search", ""},
               {"basis", "kind", ""},
               {"components", "k", ""},
               {"bytes", "bytes", ""},
               {"open_ms", "open ms", "{:.1f}"},
               {"play_ms", "play ms", "{:.1f}"},
               {"decode_ms", "open + play ms", "{:.1f}"},
               {"draco_bits", "Draco bits", ""},
               {"draco_ms", "Draco ms", "{:.1f}"},
               {"ratio", "Draco : ours", "{:.2f}"}});
  for (const std::string& name : options.clips) {
    MeshSequence sequence = load_clip(name);
    const DracoFrames draco = draco_at_kg(sequence, fan_triangles(sequence.polygons), kg);
    for (const bool smallest : {true, false}) {
      const TimedEncode timed =
          encode_timed(sequence, {ErrorMetric::kKg, kg, false}, options.basis, options.effort,
                       options.verbose, OrderMode::kFree, smallest);
      std::vector<float> positions;
      Clip opened;
      open_encoded(timed.result.file, opened);

      enum : size_t { kWhole, kDraco, kOpening, kPlaying };

      const Turns turns(
          runs,
          [&] {
            Clip clip;
            open_encoded(timed.result.file, clip);
            play(clip, positions);
          },
          [&] {
            for (const auto& frame : draco.frames)
              decode_draco(frame);
          },
          opening_of(timed.result.file), [&] { play(opened, positions); });
      table.add({{"clip", name},
                 {"vertices", sequence.vertex_count},
                 {"frames", sequence.frame_count},
                 {"search", smallest ? "smallest" : "balanced"},
                 {"basis", tools::name_of(timed.result.kind)},
                 {"components", timed.result.components},
                 {"bytes", timed.result.file.size()},
                 {"open_ms", 1e3 * turns.seconds(kOpening)},
                 {"play_ms", 1e3 * turns.seconds(kPlaying)},
                 {"decode_ms", 1e3 * turns.seconds(kWhole)},
                 {"draco_bits", draco.bits},
                 {"draco_bytes", draco.bytes()},
                 {"draco_ms", 1e3 * turns.seconds(kDraco)},
                 {"ratio", turns.ratio(kDraco, kWhole)}});
    }
  }
  return table;
}

Table run_large(const BenchOptions& options, uint32_t vertices, uint32_t frames, uint32_t shapes,
                int runs) {
  Table table({{"clip", "clip", ""},
               {"frames", "frames", ""},
               {"components", "k", ""},
               {"bytes", "bytes", ""},
               {"encode_seconds", "encode s", "{:.1f}"},
               {"encode_cpu_seconds", "CPU s", "{:.1f}"},
               {"float32_bytes", "float32 bytes", ""},
               {"peak_bytes", "peak memory", ""},
               {"peak_ratio", "ratio", "{:.2f}"},
               {"open_ms", "open ms", "{:.0f}"},
               {"base_share", "base of open", "{:.2f}"},
               {"layer_share", "first layer of open", "{:.2f}"},
               {"draco_ms", "one Draco mesh ms", "{:.1f}"},
               {"open_ratio", "ours : Draco", "{:.1f}"},
               {"frame_ms", "frame ms", "{:.2f}"}});
  MeshSequence sequence = corpus::make_wave_grid(vertices, frames, shapes);
  constexpr double kKg = 0.1;
  constexpr int kBits = 11;
  std::vector<char> draco = draco_frame(sequence, fan_triangles(sequence.polygons), 0, kBits);
  uint64_t raw = sequence.positions.size() * sizeof(float);
  TimedEncode timed = encode_timed(std::move(sequence), {ErrorMetric::kKg, kKg, false},
                                   BasisChoice::kEigenshapes, options.effort, options.verbose);
  uint64_t peak = peak_memory();
  const Bytes& file = timed.result.file;
  const ByteView base = up_to_the_first("SEGM", file), layer = up_to_the_first("BASI", file);

  enum : size_t { kOpening, kBase, kLayer, kDraco };

  const Turns turns(runs, opening_of(file), opening_of_prefix(base), opening_of_prefix(layer),
                    [&] { decode_draco(draco); });
  Clip clip;
  open_encoded(file, clip);
  std::vector<float> positions;
  double playing = median_thread_seconds(runs, [&] { play(clip, positions); });
  table.add({{"clip", "wave grid of " + std::to_string(vertices)},
             {"vertices", vertices},
             {"frames", frames},
             {"shapes", shapes},
             {"components", timed.result.components},
             {"bytes", file.size()},
             {"kg", timed.result.kg},
             {"encode_seconds", timed.wall_seconds},
             {"encode_cpu_seconds", timed.cpu_seconds},
             {"stages", timed.stages},
             {"float32_bytes", raw},
             {"peak_bytes", peak},
             {"peak_ratio", static_cast<double>(peak) / static_cast<double>(raw)},
             {"open_ms", 1e3 * turns.seconds(kOpening)},
             {"base_share", turns.ratio(kBase, kOpening)},
             {"layer_share", turns.ratio(kLayer, kOpening)},
             {"draco_bits", kBits},
             {"draco_ms", 1e3 * turns.seconds(kDraco)},
             {"open_ratio", turns.ratio(kOpening, kDraco)},
             {"frame_ms", 1e3 * playing / frames}});
  return table;
}

}  // namespace anicodec::bench
