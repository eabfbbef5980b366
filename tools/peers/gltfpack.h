// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_PEERS_GLTFPACK_H_
#define ANICODEC_TOOLS_PEERS_GLTFPACK_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <string>

namespace anicodec::peers {

/// The input of gltfpack for a clip.
enum class GltfpackInput {
  kPositions,  ///< with faces
  kNormals     ///< and normals of every frame, if the hard edges are known
};

/// A clip as the gltfpack command stores it.
struct GltfpackClip {
  int bits = 0;               ///< of a coordinate (-vp)
  double kg = 0;              ///< per cent
  uint32_t vertices = 0;      ///< that it did not merge
  uint64_t source_bytes = 0;  ///< the GLB of morph targets that gltfpack was given
  uint64_t bytes = 0;         ///< what it made of that
  /// The frames that its file plays, in the order of the source. Vertices that no face uses, which gltfpack
  /// drops, are those of the source.
  MeshSequence decoded;
};

/// The version of the command ("0.18"), empty where it cannot be run or, built without
/// meshoptimizer, its files cannot be read.
std::string gltfpack_version();

/// `gltfpack -cc` of a GLB with a morph target per frame, with the fewest bits whose KG error is at
/// most `kg`. gltfpack merges and reorders vertices: each of the source is compared with that of
/// the result whose trajectory is nearest. Cost: for each number of bits tried the command, reading
/// its file and matching; files in a private folder. Throws Error(kUsage) for a clip of one frame
/// or without faces and where 16 bits do not reach the error, Error(kUnsupported) without the
/// command, Error(kInternal) when it fails.
GltfpackClip gltfpack_at_kg(const MeshSequence& sequence, double kg,
                            GltfpackInput input = GltfpackInput::kPositions);

}  // namespace anicodec::peers

#endif  // ANICODEC_TOOLS_PEERS_GLTFPACK_H_
