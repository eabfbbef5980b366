// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ENCODE_H_
#define ANICODEC_CODEC_ENCODE_H_

#include "codec/file/encode_options.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"

namespace anicodec {

/// Encodes a sequence, decodes the result, and checks that it keeps what was asked.
/// Throws Error: kInput for a bad sequence, kUsage for a target that cannot be reached (the text
/// states the best that can), kInternal when the check fails. Deterministic; the bytes do not
/// depend on the number of threads. Memory: at most about twice the positions beside the sequence, which is
/// taken over and may lie in files (FrameArray); for clips of many vertices about 2 kB a vertex at effort 1.
EncodeResult encode(MeshSequence sequence, const EncodeOptions& options,
                    const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_H_
