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
/// depend on the number of threads. Memory: docs/memory.md; the sequence is taken over and may lie in files
/// (FrameArray). OverMemory where it would be more than options.most_bytes.
EncodeResult encode(MeshSequence sequence, const EncodeOptions& options,
                    const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_H_
