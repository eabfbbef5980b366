// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SCENE_GOALS_H_
#define ANICODEC_CODEC_SCENE_GOALS_H_

#include "codec/plan/target.h"
#include "codec/sequence/scene.h"

#include <optional>

namespace anicodec {

/// The size of a scene.
struct SceneExtent {
  double diagonal = 0;   ///< of the box around all meshes in all frames
  double spread = 0;     ///< squared distances of positions from the mean of their frame, summed
  double positions = 0;  ///< of all frames together
};

/// Cost: O(vertices x frames).
SceneExtent extent_of(const Scene& scene);

/// The goal of every mesh, by which the scene keeps its target: lengths in per cent are of the box around everything,
/// and a KG error becomes one RMSE for all. Throws Error(kUsage) for a target size, which cannot be
/// shared out.
ClipGoal shared_goal(const Target& target, const std::optional<Target>& cap,
                     const SceneExtent& extent);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SCENE_GOALS_H_
