// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ENCODE_H_
#define ANICODEC_CODEC_ENCODE_H_

#include "codec/plan/encode_options.h"
#include "codec/plan/encode_result.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/sequence/scene.h"

namespace anicodec {

/// Encodes a scene, decodes the result, and checks that it keeps what was asked. Errors asked for are those of the
/// whole scene (shared_goal()). Each mesh has the kind of basis that suits it; one that only turns and moves is a
/// single key-frame with a rigid motion where that is smallest. A mesh that comes and goes has segments for the frames
/// it is there in. The errors of the result are those of the whole, its kind is that of the first mesh. A
/// mesh that is there alone and always may be massaged first. With MassageMode::kAuto, where a sample shows that it
/// pays, the whole clip is coded both ways and the smaller file is returned: no file is larger than without, for
/// a target that is an error; for one that is a size the sample alone decides.
/// Throws Error: kInput for a bad mesh, kUsage for a target that cannot be reached (the text
/// states the best that can), kInternal when the check fails; errors name the mesh, or its frames. Deterministic; the
/// bytes do not depend on the number of threads. Memory: docs/memory.md; positions are taken over and may lie in files
/// (FrameArray). OverMemory where it would be more than options.most_bytes.
EncodeResult encode(Scene scene, const EncodeOptions& options, const Progress& progress = {});

/// The scene of this mesh alone.
EncodeResult encode(MeshSequence sequence, const EncodeOptions& options,
                    const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_H_
