// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_LOAD_OPTIONS_H_
#define ANICODEC_TOOLS_IO_BASE_LOAD_OPTIONS_H_

#include "codec/sequence/clip_library.h"
#include "codec/sequence/machine_memory.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "tools/io/base/local_origin.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace anicodec::tools {

struct LoadOptions {
  /// Overrides what the input says, an uneven table of times included; a scene is sampled at it.
  std::optional<FrameRate> rate = {};
  /// Mesh of a lone vertex cache; empty: same stem .obj, .ply or .off beside it. For a scene: the
  /// name of a mesh or node; for an Alembic archive the path of a mesh or of an object above it;
  /// empty: all of them.
  std::string mesh = {};
  /// Animation of a scene, see GltfOptions.
  std::string clip = {};
  /// Several animations of a scene as one sequence of several clips, by their names; "all":
  /// all that move anything.
  std::vector<std::string> clips = {};
  /// Without `clip` and `clips`, several takes of what moves in a scene are clips of the sequence; else
  /// the first is taken, and the others noted.
  bool takes = false;
  /// Taken from all positions before they are rounded to float32. Empty: where the mesh is far from zero, a point
  /// near it, for which it is loaded twice, else zero.
  std::optional<Point> origin = Point();
  /// Notes what float32 takes from the coordinates of meshes, however little.
  bool measures_rounding = false;
  /// Corners of an STL at one place are one vertex, see StlWeld.
  bool weld_stl = true;
  /// Most bytes that may be taken for what a file announces and does not hold: decompressed data,
  /// instances, frames of a scene.
  uint64_t memory = half_of_machine();
  /// Scenes may name files outside their folder.
  bool allow_outside = false;
  /// The clip goes back into its scene, which keeps all data around it.
  bool scene_stays = false;
  /// Stage "reading".
  Progress progress = {};
  /// Told what of a file is left out, where that is not plain from its kind.
  std::function<void(const std::string& text)> note = {};
};

/// The point that readers of meshes take from coordinates.
inline LocalOrigin origin_of(const LoadOptions& options) {
  return {.at = options.origin.value_or(Point()), .measures = options.measures_rounding};
}

/// Moves positions that a file has as floats.
inline void move_origin(const LoadOptions& options, std::span<float> positions) {
  LocalOrigin origin = origin_of(options);
  for (size_t i = 0; i < positions.size(); ++i)
    positions[i] = origin.rounded(static_cast<double>(positions[i]), i % 3);
}

/// Several animations of a scene as clips of one sequence; of one take, if nobody asked for clips, that.
template <typename LoadOne, typename LoadClips>
MeshSequence load_animations(const LoadOptions& options, const LoadOne& load_one,
                             const LoadClips& load_clips) {
  if (options.clips.empty() && !(options.takes && options.clip.empty()))
    return load_one();
  std::vector<MeshSequence> clips = load_clips();
  return clips.size() == 1 && options.clips.empty() ? std::move(clips[0])
                                                    : clip_library(std::move(clips));
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_LOAD_OPTIONS_H_
