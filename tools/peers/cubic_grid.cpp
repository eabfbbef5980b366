// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/peers/cubic_grid.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anicodec::peers {

GriddedClip on_grid(const MeshSequence& sequence, double step) {
  GriddedClip clip;
  clip.step = step;
  std::fill_n(clip.origin, 3, std::numeric_limits<double>::infinity());
  double high = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < sequence.positions.size(); ++i)
    clip.origin[i % 3] = std::min(clip.origin[i % 3], double{sequence.positions[i]});
  for (size_t i = 0; i < sequence.positions.size(); ++i)
    high = std::max(high, double{sequence.positions[i]} - clip.origin[i % 3]);
  if (!(high / step < 2147483647.0))
    throw Error(ErrorKind::kUsage, "the grid is too fine");
  clip.values.resize(sequence.positions.size());
  for (size_t i = 0; i < clip.values.size(); ++i)
    clip.values[i] = static_cast<uint32_t>(
        std::llround((double{sequence.positions[i]} - clip.origin[i % 3]) / step));
  clip.largest = std::ranges::max(clip.values);

  size_t width = size_t{3} * sequence.vertex_count;
  std::vector<float> frame(width);
  CompareOptions options;
  options.sted = false;
  clip.error = compare(
      sequence.polygons, sequence.vertex_count, sequence.frame_count, frames_of(sequence),
      [&](uint32_t f) -> std::span<const float> {
        for (size_t i = 0; i < width; ++i)
          frame[i] = static_cast<float>(clip.origin[i % 3] + step * clip.values[f * width + i]);
        return frame;
      },
      options);
  return clip;
}

GriddedClip on_grid_at_kg(const MeshSequence& sequence, double kg) {
  double reach = diagonal(sequence);
  double step = reach * kg / 100;
  GriddedClip best;
  for (int round = 0; round < 16; ++round) {
    GriddedClip clip = on_grid(sequence, step);
    double ratio = clip.error.kg > 0 ? kg / clip.error.kg : 2;
    if (clip.error.kg <= kg && (best.values.empty() || clip.step > best.step))
      best = std::move(clip);
    if ((ratio >= 1 && ratio < 1.005) || step > reach)
      break;
    step *= std::min(ratio, 2.0) * 0.999;
  }
  if (best.values.empty())
    throw Error(ErrorKind::kUsage, "no grid has the error asked for");
  return best;
}

}  // namespace anicodec::peers
