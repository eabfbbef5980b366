// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/play/play.h"

#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "corpus/clips.h"
#include "tests/bench/bench_clips.h"
#include "tests/bench/benches.h"
#include "tests/bench/play_peers.h"
#include "tests/bench/stopwatch.h"
#include "tools/peers/draco_frames.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace anicodec::bench {
namespace {

constexpr uint32_t kPassFrames = 4;  // per pass
constexpr int kDracoBits = 11;

/// A segment with narrow components only and a moving base, and somewhere to play four frames to.
struct Stage {
  Stage(BasisKind kind, uint32_t vertices, uint32_t components) {
    segment.kind = kind;
    segment.vertices = vertices;
    segment.components = components;
    segment.frames = kPassFrames;
    uint32_t seed = 1;
    auto random = [&] { return (seed = seed * 1664525 + 1013904223) >> 16; };
    segment.narrow.resize(size_t{block_count(vertices)} * components * segment.channels() * kBlock);
    for (size_t i = 0; i < segment.narrow.size(); ++i)
      segment.narrow[i] = static_cast<int16_t>(random());
    segment.pose.resize(size_t{block_count(vertices)} * 3 * kBlock);
    for (size_t i = 0; i < segment.pose.size(); ++i)
      segment.pose[i] = static_cast<float>(random());
    segment.weights.resize(size_t{kPassFrames} * components * segment.weight_channels());
    for (size_t i = 0; i < segment.weights.size(); ++i)
      segment.weights[i] = 1e-9F * static_cast<float>(random());
    segment.pose_maps.resize(kPassFrames);
    for (uint32_t f = 0; f < kPassFrames; ++f) {
      states[f] = frame_state(segment, f);
      positions[f].resize(size_t{3} * vertices);
      outputs[f].data = positions[f].data();
    }
  }

  void play(uint32_t frames) {
    anicodec::play(states.data(), frames, 0, segment.vertices, outputs.data());
  }

  Segment segment;
  std::array<FrameState, kPassFrames> states;
  std::array<std::vector<float>, kPassFrames> positions;
  std::array<VertexOutput, kPassFrames> outputs;
};

/// Processor seconds of each work, `runs` of them in turns: every time often enough to be
/// measurable, after one more time that brings what fits into the caches.
std::vector<std::vector<double>> in_turns(int runs,
                                          const std::vector<std::function<void()>>& works) {
  constexpr double kMeasurable = 2e-3;
  std::vector<int> times;
  for (const auto& work : works) {
    work();
    double once = median_thread_seconds(3, work);
    times.push_back(std::clamp(static_cast<int>(kMeasurable / (once + 1e-9)), 1, 1000));
  }
  std::vector<std::vector<double>> seconds(works.size());
  for (int r = 0; r < runs; ++r) {
    for (size_t w = 0; w < works.size(); ++w) {
      works[w]();
      Stopwatch watch(CLOCK_THREAD_CPUTIME_ID);
      for (int t = 0; t < times[w]; ++t)
        works[w]();
      seconds[w].push_back(watch.seconds() / times[w]);
    }
  }
  return seconds;
}

/// Median over the turns of a : b.
double ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (size_t i = 0; i < a.size(); ++i)
    ratios.push_back(a[i] / b[i]);
  return median(ratios);
}

struct Peer {
  std::string name;
  uint32_t vertices;
  std::vector<char> draco;  // one frame
};

std::vector<Peer> draco_peers(const BenchOptions& options, const std::vector<uint32_t>& vertices) {
  std::vector<Peer> all;
  auto add = [&](const std::string& name, const MeshSequence& sequence) {
    all.push_back({name, sequence.vertex_count,
                   peers::draco_frame(sequence, fan_triangles(sequence.polygons), 0, kDracoBits)});
  };
  for (const std::string& name : options.clips)
    add(name, load_clip(name));
  for (uint32_t v : vertices)
    if (v > 0)
      add("wave grid", corpus::make_wave_grid(v, 2, 30));
  return all;
}

volatile int32_t sum_read;  // so that reading is not left out

}  // namespace

Table run_play(const BenchOptions& options, const std::vector<uint32_t>& vertices,
               const std::vector<uint32_t>& components, int runs) {
  const PlayPeers* peers = play_peers();
  if (!peers)
    throw Error(ErrorKind::kUsage, "the peers of this bench need AVX2 and FMA");
  Table table({{"basis", "kind", ""},
               {"components", "k", ""},
               {"vertices", "vertices", ""},
               {"one_ns", "1 frame ns", "{:.2f}"},
               {"four_ns", "4 frames ns", "{:.2f}"},
               {"one_read", "1 : read", "{:.2f}"},
               {"one_fma", "1 : FMA", "{:.2f}"},
               {"four_fma", "4 : FMA", "{:.2f}"},
               {"four_limit", "4 : limit", "{:.2f}"},
               {"eigen", "Eigen : 1", "{:.2f}"},
               {"draco", "Draco : 1", "{:.1f}"},
               {"draco_four", "Draco : 4", "{:.1f}"}});
  std::vector<double> eigen_ratios;
  const std::vector<Peer> all = draco_peers(options, vertices);
  for (BasisKind kind : {BasisKind::kEigentrajectories, BasisKind::kEigenshapes}) {
    const bool trajectories = kind == BasisKind::kEigentrajectories;
    for (uint32_t k : components) {
      for (const Peer& peer : all) {
        const uint32_t v = peer.vertices;
        Stage stage(kind, v, k);
        const auto eigen = peers->eigen_product(v, k, trajectories);
        const auto& narrow = stage.segment.narrow;
        float result = 0;
        size_t multiplied = 0;
        const auto seconds =
            in_turns(runs, {[&] { stage.play(1); }, [&] { stage.play(kPassFrames); },
                            [&] { sum_read = peers->read_all(narrow.data(), narrow.size()); },
                            [&] { multiplied = peers->multiply_adds(size_t{1} << 24, &result); },
                            [&] { eigen->run(); }, [&] { peers::decode_draco(peer.draco); }});
        const auto &one = seconds[0], &four = seconds[1];
        const double per_vertex = 1e9 / v;
        // The moving base takes as many as three components of vectors.
        const double limit = 3.0 * v * (k + 3) / static_cast<double>(multiplied);
        // Four frames cannot be faster than their multiply-adds, nor than reading once.
        const double fma_ratio = ratio(four, seconds[3]) / limit / kPassFrames;
        const double four_limit = std::min(fma_ratio, ratio(four, seconds[2]));
        eigen_ratios.push_back(ratio(seconds[4], one));
        table.add({{"basis", trajectories ? "trajectories" : "shapes"},
                   {"components", k},
                   {"clip", peer.name},
                   {"vertices", v},
                   {"one_ns", per_vertex * median(one)},
                   {"four_ns", per_vertex * median(four) / kPassFrames},
                   {"read_ns", per_vertex * median(seconds[2])},
                   {"eigen_ns", per_vertex * median(seconds[4])},
                   {"draco_ns", per_vertex * median(seconds[5])},
                   {"one_read", ratio(one, seconds[2])},
                   {"one_fma", ratio(one, seconds[3]) / limit},
                   {"four_fma", fma_ratio},
                   {"four_limit", four_limit},
                   {"eigen", eigen_ratios.back()},
                   {"draco", ratio(seconds[5], one)},
                   {"draco_four", ratio(seconds[5], four) * kPassFrames}});
      }
    }
  }
  table.add(
      {{"basis", "median"}, {"kernels", play_kernels_name()}, {"eigen", median(eigen_ratios)}});
  return table;
}

}  // namespace anicodec::bench
