// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/massage.h"

#include "codec/massage/denoise.h"
#include "codec/massage/distance_limit.h"
#include "codec/massage/shape_fit.h"
#include "codec/massage/shape_weights.h"
#include "codec/massage/untangle.h"
#include "codec/massage/welded_surface.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace anicodec {
namespace {

constexpr uint32_t kFramesAtOnce = 32;  // between two reports
constexpr int kFittingRounds = 3;       // these lift what sliding cut

}  // namespace

MassageResult massage(const MeshSequence& sequence, const MassageOptions& options,
                      const Progress& progress) {
  check(sequence);
  if (options.reference >= sequence.frame_count)
    throw Error(ErrorKind::kUsage, "the massage is to follow frame " +
                                       std::to_string(options.reference) + " of " +
                                       std::to_string(sequence.frame_count));
  if (!(options.strength > 0 && options.strength < 1))
    throw Error(ErrorKind::kUsage, "the strength of the massage is between 0 and 1");
  const WeldedSurface clip(sequence);
  if (clip.topology.triangles.empty())
    throw Error(ErrorKind::kInput, "there is no surface to massage: no face has three vertices");
  MassageResult result;
  result.sequence = sequence;
  result.frames.resize(sequence.frame_count);
  const Positions reference = clip.frame(sequence.frame(options.reference));
  const SlidingSolver slider(clip.topology, reference);
  const RowMatrix shape = shape_matrix(clip.topology, reference, ShapeWeights::kMeanValue);
  ShapeFitOptions fitting;
  fitting.lambda = 1 - options.strength;
  fitting.rounds = kFittingRounds;
  const double tolerance =
      options.tolerance > 0 ? options.tolerance : std::numeric_limits<double>::infinity();
  PerThread<ShapeFit> fitters([&] { return ShapeFit(clip.topology, shape); });
  const bool settles = options.remove_noise && can_denoise(sequence);
  auto massage_frame = [&](uint32_t f) {
    if (f == options.reference)
      return;
    Positions v = clip.frame(sequence.frame(f));
    Surface surface(clip.topology, v);
    MassagedFrame& frame = result.frames[f];
    frame.sliding = slider.run(surface, SlidingOptions(), &v);
    if (!settles) {
      surface.build_index();
      frame.fitting = fitters.local().run(surface, fitting, &v).convergence;
    }
    clip.store(v, result.sequence.frame(f));
  };
  auto in_parallel = [&](const char* stage, const auto& work) {
    for (uint32_t first = 0; first < sequence.frame_count; first += kFramesAtOnce) {
      if (progress)
        progress(stage, static_cast<double>(first) / sequence.frame_count);
      parallel_for(first, std::min(sequence.frame_count, first + kFramesAtOnce), work);
    }
  };
  in_parallel("massaging", massage_frame);
  if (settles) {
    DenoiseOptions noise;
    const double importance = options.strength / (1 - options.strength);
    noise.patch_allowance *= importance;
    noise.frame_allowance *= importance;
    result.noise = denoise(sequence, clip, slider.freedom(), noise, &result.sequence);
  }
  in_parallel("settling", [&](uint32_t f) {
    Surface surface(clip.topology, clip.frame(sequence.frame(f)));
    surface.build_index();
    Positions v = clip.frame(std::as_const(result.sequence).frame(f));
    untangle(surface, &v);
    result.frames[f].drawn_back = limit_distance(surface, tolerance, &v);
    clip.store(v, result.sequence.frame(f));
  });
  return result;
}

}  // namespace anicodec
