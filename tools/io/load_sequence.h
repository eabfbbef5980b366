// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_LOAD_SEQUENCE_H_
#define ANICODEC_TOOLS_IO_LOAD_SEQUENCE_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/scene.h"
#include "tools/io/base/load_options.h"

#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

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

/// The files behind such inputs, in the order of load_sequence(), patterns expanded. Throws as it
/// for a pattern without a match, folders and unknown kinds.
std::vector<std::string> sequence_files(std::span<const std::string> inputs);

/// True for the extensions that load_sequence reads, in any case of letters.
bool is_sequence_input(const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_LOAD_SEQUENCE_H_
