// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_LOAD_SEQUENCE_H_
#define ANICODEC_TOOLS_IO_LOAD_SEQUENCE_H_

#include "codec/sequence/machine_memory.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/sequence/scene.h"
#include "tools/io/gltf/gltf_material.h"
#include "tools/io/gltf/moving_glb.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Loads what the command line names, one of
///   - a mesh (.obj .ply .off .stl) and a vertex cache (.pc2 .mdd), in either order,
///   - a vertex cache alone, with options.mesh or a mesh beside it,
///   - frames of one format: meshes of equal connectivity in the order given, which is noted where it is
///     not that of their numbers,
///   - a scene (.gltf .glb), baked,
///   - an Alembic archive (.abc), see read_alembic(),
///   - a pattern of glob(3) for any of these, its results in natural order,
///   - one mesh: a single frame,
///   - "-": a scene in one file, an archive or a mesh (.obj .ply .off) from the standard input.
/// The clip is named by the stem of the first file. Positions are held once. Throws Error(kInput)
/// naming file and place, Error(kUsage) for inputs that do not make one clip.
MeshSequence load_sequence(std::span<const std::string> inputs, const LoadOptions& options = {});

/// Loads frames of one format (.obj .ply .off) whose connectivity may change: a mesh for each run
/// of frames that share one. For an Alembic archive: a mesh for each object and connectivity.
/// Throws as load_sequence().
Scene load_topologies(std::span<const std::string> inputs, const LoadOptions& options = {});

/// A glTF scene in one file with its clip as an extension, see write_moving_glb(): `clip` is that of
/// load_sequence() with the same options.
std::string carry_clip(const std::string& scene, const LoadOptions& options,
                       const StillSurface& still, std::string_view clip);

/// The files behind such inputs, in the order of load_sequence(), patterns expanded. Throws as it
/// for a pattern without a match, folders and unknown kinds.
std::vector<std::string> sequence_files(std::span<const std::string> inputs);

/// True for the extensions that load_sequence reads, in any case of letters.
bool is_sequence_input(const std::string& path);

/// The images inside a glTF scene. Throws as load_sequence().
std::vector<GltfImage> load_images(const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_LOAD_SEQUENCE_H_
