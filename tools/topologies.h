// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_TOPOLOGIES_H_
#define ANICODEC_TOOLS_TOPOLOGIES_H_

#include "codec/encode.h"
#include "codec/mesh_sequence.h"
#include "codec/progress.h"

#include <string>
#include <vector>

namespace anicodec::tools {

/// Encodes runs of frames, each of a connectivity of its own, to one file. Lengths in per cent are
/// of the box around all runs; errors in the result are the largest of any run. Throws
/// Error(kUsage) for a target size, which cannot be shared out, and as encode(), naming `name` and
/// the frames.
EncodeResult encode_topologies(std::vector<MeshSequence> runs, EncodeOptions options,
                               const std::string& name, const Progress& progress);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_TOPOLOGIES_H_
