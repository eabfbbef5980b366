// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_MESH_INPUT_H_
#define ANICODEC_TOOLS_INPUTS_MESH_INPUT_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/surface/surface_frame.h"
#include "codec/transfer/mesh_map.h"

#include <span>
#include <string>

namespace anicodec::tools {

/// The mesh of a file that holds one frame, with all that it has. Throws Error(kInput), and
/// Error(kUsage) for more frames.
MeshSequence load_mesh(const std::string& path, const Progress& progress);

/// Its faces and positions alone.
SurfaceFrame surface_of(const MeshSequence& mesh);

/// The mesh with other positions: normals and tangents, which were those of the shape, go.
MeshSequence with_positions(MeshSequence mesh, std::span<const float> positions);

/// Gives a mesh what `surface` has at its corners: texture coordinates, colours and other numbers for each corner,
/// and materials. A face takes the material below most of its corners.
void carry_details(const MeshSequence& surface, const MeshMap& map, MeshSequence* mesh);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_MESH_INPUT_H_
