// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Valid files whose mesh, motion, kinds of segments and parameters are drawn at random, for
// generate.py. The same seed gives the same file.
//
// usage: random_vectors SEED FILE.anic
#include "codec/encode.h"
#include "codec/metrics/metrics.h"
#include "codec/sequence/error.h"
#include "corpus/clips.h"
#include "tests/conformance/vector_recipes.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

constexpr uint32_t kMostVertices = 400, kMostFrames = 40;

class RandomVector {
 public:
  explicit RandomVector(uint64_t seed) : numbers_(seed) {
    numbers_.below(2);  // neighbouring seeds differ from the second number on
  }

  /// A third of the files come from the encoder's search, the others from recipes.
  Bytes make() {
    MeshSequence clip = random_clip();
    return numbers_.below(3) == 0 ? searched(clip) : by_recipes(std::move(clip));
  }

 private:
  bool one_in(uint32_t count) { return numbers_.below(count) == 0; }

  template <class T>
  T any(std::initializer_list<T> values) {
    return *(values.begin() + numbers_.below(static_cast<uint32_t>(values.size())));
  }

  MeshSequence random_clip() {
    if (one_in(5))
      return hub();
    std::vector<corpus::ClipInfo> all = corpus::clips();
    const corpus::ClipInfo& info = all[numbers_.below(static_cast<uint32_t>(all.size()))];
    if (!info.scalable) {
      MeshSequence clip = corpus::make_clip(info.name);
      if (clip.vertex_count <= kMostVertices && clip.frame_count <= kMostFrames)
        return clip;
    }
    return corpus::make_scaled(info.scalable ? info.name : "limb",
                               100 + numbers_.below(kMostVertices - 100),
                               1 + numbers_.below(kMostFrames));
  }

  Bytes searched(const MeshSequence& clip) {
    EncodeOptions options;
    options.effort = any({Effort::kFast, Effort::kNormal});
    options.order = any({OrderMode::kFree, OrderMode::kVertices, OrderMode::kAll});
    options.smallest = one_in(2);
    options.target = {ErrorMetric::kKg, any({0.05, 0.3, 2.0}), false};
    if (one_in(3))
      options.cap = Target{ErrorMetric::kMaxError, any({0.2, 2.0}), false};
    if (one_in(2)) {
      options.basis = BasisChoice::kKeyframes;
      options.target = {};
      options.cap = {};
      options.keyframes = 1 + numbers_.below(std::min(6U, clip.frame_count));
      options.keyframe_poses = any({KeyframePoses::kNative, KeyframePoses::kDraco});
    }
    return encode(clip, options).file;
  }

  Bytes by_recipes(MeshSequence clip) {
    const double length = diagonal(clip);
    std::vector<Recipe> recipes;
    for (uint32_t first = 0; first < clip.frame_count;) {
      const uint32_t left = clip.frame_count - first;
      const uint32_t frames = one_in(2) ? left : 1 + numbers_.below(left);
      recipes.push_back(random_recipe(frames, length > 0 ? length : 1));
      first += frames;
    }
    return file_of(std::move(clip), recipes, [&](ClipsRecord& record) { describe(&record); });
  }

  Recipe random_recipe(uint32_t frames, double length) {
    Recipe r = recipe(frames, any({BasisKind::kEigenshapes, BasisKind::kEigentrajectories}),
                      any({0.0005, 0.004, 0.03}) * length, any<uint8_t>({8, 12, 16, 20, 24}),
                      static_cast<uint8_t>(1 + numbers_.below(8)),
                      static_cast<uint8_t>(1 + numbers_.below(255)),
                      any({RefitSchedule::kNone, RefitSchedule::kSparse, RefitSchedule::kMedium}));
    LinearSettings& settings = r.settings;
    settings.layers = 1 + numbers_.below(3);
    if (one_in(2))
      settings.alike = static_cast<uint8_t>(1 + numbers_.below(255));
    settings.layers_anew = one_in(2);
    settings.pose_factor = any({0.02, 0.5, 2.0, 8.0});
    settings.weight_factor = any({0.5, 2.4, 10.0});
    if (one_in(2))
      settings.joint_lambda = any({0.1, 1.0});
    settings.refit_weights = one_in(2);
    if (r.kind == BasisKind::kEigentrajectories && one_in(2)) {
      r.regions = 2 + numbers_.below(7);
      r.region_of = [regions = r.regions, scattered = one_in(3)](uint32_t n) {
        Numbers numbers(n);
        Vector<uint8_t> result(n);
        for (uint32_t v = 0; v < n; ++v)  // none of them is empty
          result[v] = static_cast<uint8_t>(v < regions ? v
                                           : scattered ? numbers.below(regions)
                                                       : uint64_t{v} * regions / n);
        return result;
      };
      for (uint32_t k = 0; k < r.regions && one_in(2); ++k)
        settings.components.push_back(1 + numbers_.below(9));
    }
    switch (r.regions > 1 ? 5 : numbers_.below(5)) {
      case 0:
        r.change = one_in(2) ? with_partners : exactly_with_partners;
        break;
      case 1:
        r.change = scramble_weights;
        break;
      case 2:
        if (settings.layers == 1)
          r.change = scramble_coefficients;
        break;
      default:
        break;
    }
    return r;
  }

  void describe(ClipsRecord* record) {
    record->up = static_cast<uint8_t>(numbers_.below(3));
    record->metres_per_unit = any({0.0, 0.01, 1.0});
    for (ClipRecord& clip : record->clips) {
      clip.loop = one_in(2);
      clip.start_time = numbers_.within(100) / 8.0;
    }
  }

  Numbers numbers_;
};

int run(int argc, char** argv) {
  char* end = nullptr;
  const uint64_t seed = argc == 3 ? std::strtoull(argv[1], &end, 10) : 0;
  if (argc != 3 || end == argv[1] || *end != '\0') {
    std::fprintf(stderr, "usage: random_vectors SEED FILE.anic\n");
    return 2;
  }
  const Bytes bytes = RandomVector(seed).make();
  std::ofstream file(argv[2], std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  return file.flush().good() ? 0 : 1;
}

}  // namespace
}  // namespace anicodec

int main(int argc, char** argv) {
  try {
    return anicodec::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "random_vectors: %s\n", error.what());
    return 1;
  }
}
