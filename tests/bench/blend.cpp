// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/clip_library.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tests/bench/benches.h"
#include "tests/bench/stopwatch.h"

#include <anicodec/anicodec.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace anicodec::bench {
namespace {

constexpr uint32_t kFrames = 24;
constexpr int kPlays = 8;  // in a trial

/// Two clips of a limb, which share a basis.
MeshSequence two_clips(uint32_t vertices) {
  std::vector<MeshSequence> clips;
  for (uint32_t c = 0; c < 2; ++c) {
    MeshSequence clip = corpus::make_scaled("limb", vertices, 2 * kFrames);
    clip.name = c == 0 ? "first" : "second";
    const size_t row = size_t{3} * clip.vertex_count;
    if (c == 1)
      clip.positions.erase(clip.positions.begin(),
                           clip.positions.begin() + static_cast<ptrdiff_t>(kFrames * row));
    clip.frame_count = kFrames;
    clip.positions.resize(kFrames * row);
    clips.push_back(std::move(clip));
  }
  return clip_library(std::move(clips));
}

void check(anic_status status) {
  if (status != ANIC_OK)
    throw Error(ErrorKind::kInternal, anic_get_status_text(status));
}

}  // namespace

Table run_blend(const BenchOptions& options, const std::vector<uint32_t>& sizes, int runs) {
  Table table({{"vertices", "vertices", ""},
               {"basis", "basis", ""},
               {"components", "k", ""},
               {"one_us", "one clip us", "{:.1f}"},
               {"blend_us", "two clips us", "{:.1f}"},
               {"ratio", "ratio", "{:.3f}"}});
  for (const uint32_t vertices : sizes) {
    for (const auto& [basis, name] : {std::pair{BasisChoice::kEigentrajectories, "trajectories"},
                                      std::pair{BasisChoice::kEigenshapes, "shapes"}}) {
      EncodeOptions encoding;
      encoding.target = {ErrorMetric::kKg, 0.2, false};
      encoding.basis = basis;
      encoding.effort = options.effort;
      encoding.order = OrderMode::kFree;
      const MeshSequence source = two_clips(vertices);
      const EncodeResult result = encode(source, encoding);
      if (result.segments.size() != 1)
        throw Error(ErrorKind::kInternal, "the clips share no basis");
      anic_asset* opened = nullptr;
      anic_context* made = nullptr;
      check(anic_open_asset(result.file.data(), result.file.size(), nullptr, &opened, nullptr));
      const std::unique_ptr<anic_asset, void (*)(anic_asset*)> asset(opened, anic_close_asset);
      check(anic_create_context(opened, nullptr, &made));
      const std::unique_ptr<anic_context, void (*)(anic_context*)> context(made,
                                                                           anic_destroy_context);
      std::vector<float> points(size_t{3} * source.vertex_count);
      anic_output output = ANIC_INIT(anic_output);
      output.data = points.data();
      output.size = points.size() * sizeof(float);
      const auto play = [&](bool blends) {
        const Stopwatch watch(CLOCK_THREAD_CPUTIME_ID);
        for (int i = 0; i < kPlays; ++i) {
          const double time = 0.31 + 0.07 * i;
          check(anic_seek_time(made, time, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP));
          if (blends)
            check(anic_blend(made, 1, 0.5 * time, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP, 0.4));
          check(anic_write_positions(made, 0, ANIC_WHEN_CURRENT, 0, source.vertex_count, &output));
        }
        return watch.seconds() / kPlays;
      };
      std::vector<double> one, two, ratios;
      play(true);
      for (int i = 0; i < runs; ++i) {  // paired: what disturbs one of a pair disturbs the other
        one.push_back(play(false));
        two.push_back(play(true));
        ratios.push_back(two.back() / one.back());
      }
      table.add({{"vertices", source.vertex_count},
                 {"basis", name},
                 {"components", result.components},
                 {"one_us", 1e6 * median(one)},
                 {"blend_us", 1e6 * median(two)},
                 {"ratio", median(ratios)}});
    }
  }
  return table;
}

}  // namespace anicodec::bench
