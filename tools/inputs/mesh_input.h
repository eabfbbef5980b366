// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_MESH_INPUT_H_
#define ANICODEC_TOOLS_INPUTS_MESH_INPUT_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/surface/surface_frame.h"

#include <string>
#include <vector>

namespace anicodec::tools {

/// The mesh of a file that holds one frame. Throws Error(kInput), and Error(kUsage) for more
/// frames.
SurfaceFrame load_mesh(const std::string& path, const Progress& progress);

/// A mesh with other positions, as a sequence to write.
MeshSequence with_positions(const SurfaceFrame& mesh, std::vector<float> positions);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_MESH_INPUT_H_
