// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_CLIP_LIBRARY_H_
#define ANICODEC_CODEC_SEQUENCE_CLIP_LIBRARY_H_

#include "codec/sequence/mesh_sequence.h"

#include <vector>

namespace anicodec {

/// Several clips of one mesh as one sequence with MeshSequence::clips, in the order given. The mesh
/// and what it has beside positions is that of the first clip; attributes that change in any clip
/// have values for all frames. Throws Error(kInput) naming the first clip that does not fit: another
/// connectivity, attributes of another kind, axis or unit; Error(kUsage) if there is none. Names
/// may still be the same: check() refuses that.
MeshSequence clip_library(std::vector<MeshSequence> clips);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_CLIP_LIBRARY_H_
