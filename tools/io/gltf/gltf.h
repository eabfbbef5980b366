// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "tools/io/gltf/gltf_document.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

struct GltfOptions {
  /// The frame rate; default: what anicodec wrote beside the keys, else the grid that they stand on
  /// (grid_rate), else one from 30 on that ends with the last key. Without it, frames between keys that are far apart
  /// are left out where all moves evenly.
  std::optional<FrameRate> rate = {};
  /// Name of the mesh or node to take; empty: all of the scene.
  std::string mesh = {};
  /// Name or number of the animation, or several with "+" between them that are played together; "none"
  /// for the pose without; empty: the first that moves something, and those that move something else.
  std::string clip = {};
  /// Taken from the positions before they are rounded to float.
  Point origin = {};
  /// Most bytes that decompressed buffers, keys, geometry, and frames may take, each.
  uint64_t memory_limit = uint64_t{1} << 36;
  /// Buffers may stand outside the folder of the file, by URIs that climb with "..".
  bool allow_outside = false;
  /// The clip goes back into the scene: data around it are not noted as left out.
  bool scene_stays = false;
  /// Faces of what has no normals are flat, as glTF says; false: nothing is known of their edges.
  bool flat_without_normals = true;
  /// Draco decodes in a process with limits (run_guarded); false: here, for tests of it.
  bool isolate = true;
  /// Stage "reading".
  Progress progress = {};
  /// Told what is left out (other takes of what moves, too), and what was chosen where the file does not say.
  std::function<void(const std::string& text)> note = {};
};

/// Bakes a .gltf or .glb: all triangles of the scene's meshes become one mesh in world space (Y up,
/// metres), moved by skins (linear blending), morph targets and nodes. Faces turn where a node mirrors; of one
/// that does so at some times there are two surfaces, each shown in its turn. Instances are baked. Frames stand at multiples of
/// 1/rate from the first key of the animation to the last. Vertices stay as they are, seams
/// included, primitives with the same accessors share theirs; points and lines are passed over.
/// UV sets and colours are kept (moved as the material says where the scene does not stay), normals and
/// tangents as in the first frame, hard edges where there are none, names of materials, meshes and nodes,
/// numbers of nodes without one. The clip has the name of the (first) animation where others are left out. Throws
/// Error(kInput) "name: /json/pointer: reason", Error(kUnsupported), Error(kUsage) for a mesh or
/// clip that is not there.
MeshSequence parse_gltf(std::string_view bytes, std::string_view name, const GltfResolver& resolve,
                        const GltfOptions& options = {});

/// Animations of a document as clips with their names: each named one; for {"all"} each that has a
/// length and moves a vertex; without names the takes. A take combines animations that move
/// different things, so that every animation that moves a vertex is in a clip. An animation without
/// a name is "clip N", a name that is there already gets a number. The only take, and a document
/// without animations, is as parse_gltf() has it. options.memory_limit holds for all together.
/// Throws as parse_gltf(), Error(kUsage) where "all" are none.
std::vector<MeshSequence> parse_gltf_clips(std::string_view bytes, std::string_view name,
                                           const GltfResolver& resolve, GltfOptions options,
                                           const std::vector<std::string>& names);

/// The same for a document that has been read.
MeshSequence bake_gltf(const GltfDocument& document, const GltfOptions& options);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_H_
