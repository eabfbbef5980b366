// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_CLIP_RECORD_H_
#define ANICODEC_CODEC_FILE_CLIP_RECORD_H_

#include "codec/plan/encode_options.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/records.h"

#include <vector>

namespace anicodec {

/// The metadata of a file and its clips without the errors, which are yet to be measured: names,
/// clocks, coordinates, and what was asked for. `goals`: of each clip.
ClipsRecord clips_record(const MeshSequence& sequence, const FileOptions& options,
                         const std::vector<ClipGoal>& goals);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_CLIP_RECORD_H_
