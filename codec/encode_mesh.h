// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ENCODE_MESH_H_
#define ANICODEC_CODEC_ENCODE_MESH_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/plan/encode_result.h"
#include "codec/plan/mesh_plan.h"
#include "codec/segment/encoded_segment.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "format/bytes.h"
#include "format/records.h"

#include <vector>

namespace anicodec {

/// A mesh ready for a file, by itself or with others.
struct EncodedMesh {
  EncodeResult result;  ///< without the file
  MeshLayout layout;  ///< as far as files need it: without topology and the ways back to the source
  ClipsRecord record;                    ///< of its own file, with the errors measured
  std::vector<EncodedSegment> segments;  ///< in the order of a file

  std::vector<const EncodedSegment*> list() const;

  /// The file of this mesh alone.
  Bytes file() const;
};

/// Encodes a mesh, decodes the file of it alone, and checks that it keeps what the plan promises. The sequence is
/// taken over and may lie in files (FrameArray). Deterministic, whatever the threads. Throws Error: kInput for values
/// that the format cannot hold, kUsage for a target that cannot be reached (the text states the best that can),
/// kInternal when the check fails; OverMemory where more than plan.most_bytes would be held.
/// @pre check(sequence) throws nothing
EncodedMesh encode_mesh(MeshSequence sequence, const MeshPlan& plan, const Progress& progress);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_MESH_H_
