// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/scene_goals.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {
namespace {

/// Length of the diagonal of the box around all meshes.
double diagonal_of(const Scene& scene) {
  MeshSequence corners;  // two vertices: of the box around each
  for (const SceneMesh& mesh : scene.meshes) {
    const FrameArray& positions = mesh.sequence.positions;
    std::array<float, 3> low{positions[0], positions[1], positions[2]}, high = low;
    for (size_t i = 0; i < positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], positions[i]);
      high[i % 3] = std::max(high[i % 3], positions[i]);
    }
    corners.positions.insert(corners.positions.end(), low.begin(), low.end());
    corners.positions.insert(corners.positions.end(), high.begin(), high.end());
  }
  return diagonal(corners);
}

/// Adds how far positions are from the mean of their frame.
void add_spread(const Scene& scene, SceneExtent* extent) {
  struct Frame {
    std::array<double, 3> origin{}, sum{};  // sums are from there, to stay exact far off
    double squared = 0, count = 0;
  };

  std::vector<Frame> frames(scene.clip.frame_count);
  for (const SceneMesh& mesh : scene.meshes) {
    uint32_t mesh_frame = 0;
    for (const FrameRun& run : mesh.present_in) {
      for (uint32_t f = run.first; f < run.first + run.count; ++f) {
        const std::span<const float> positions = mesh.sequence.frame(mesh_frame++);
        Frame& frame = frames[f];
        if (frame.count == 0)
          std::copy_n(positions.begin(), 3, frame.origin.begin());
        frame.count += mesh.sequence.vertex_count;
        for (size_t i = 0; i < positions.size(); ++i) {
          const double x = static_cast<double>(positions[i]) - frame.origin[i % 3];
          frame.sum[i % 3] += x;
          frame.squared += x * x;
        }
      }
    }
  }
  for (const Frame& frame : frames) {
    if (frame.count == 0)
      continue;
    double of_mean = 0;
    for (double x : frame.sum)
      of_mean += x * x / frame.count;
    extent->spread += std::max(0.0, frame.squared - of_mean);
    extent->positions += frame.count;
  }
}

}  // namespace

SceneExtent extent_of(const Scene& scene) {
  SceneExtent extent;
  extent.diagonal = diagonal_of(scene);
  add_spread(scene, &extent);
  return extent;
}

ClipGoal shared_goal(const Target& target, const std::optional<Target>& cap,
                     const SceneExtent& extent) {
  if (is_size(target.metric))
    throw Error(ErrorKind::kUsage, "a target size cannot be shared out among meshes");
  ClipGoal goal = clip_goals(target, cap, {extent.diagonal}, extent.diagonal)[0];
  if (goal.bound.metric == ErrorMetric::kKg && extent.spread > 0)
    goal.bound = {ErrorMetric::kRmse,
                  goal.bound.value / 100 * std::sqrt(extent.spread / extent.positions)};
  return goal;
}

}  // namespace anicodec
